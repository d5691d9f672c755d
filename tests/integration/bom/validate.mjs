// SPDX-License-Identifier: BSD-3-Clause
// node validate.mjs BOM
import { readFileSync } from 'node:fs';
import { Spec, Validation } from '@cyclonedx/cyclonedx-library';

const text = readFileSync(process.argv[2], 'utf8');
const version = JSON.parse(text).specVersion;
if (!Object.values(Spec.Version).includes(version)) throw new Error(`no such version of CycloneDX: ${version}`);
const validator = new Validation.JsonStrictValidator(version);
const fault = await validator.validate(text);
if (fault !== null) {
  console.error(JSON.stringify(fault, null, 2));
  process.exit(1);
}
// A schema that takes anything would prove nothing.
const broken = text.replace('"type": "library"', '"type": "something"');
if (broken === text || (await validator.validate(broken)) === null) throw new Error('the schema finds no fault');
console.log(`valid CycloneDX ${version}`);
