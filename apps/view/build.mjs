// SPDX-License-Identifier: BSD-3-Clause
// Bundles the page and writes it as a C++ source, and the licences of all that is in it: node build.mjs OUTPUT.cc LICENCES.txt
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import { build } from 'esbuild';

const [output, licencesOutput] = process.argv.slice(2);
if (!licencesOutput) {
  console.error('usage: node build.mjs OUTPUT.cc LICENCES.txt');
  process.exit(2);
}

const bundled = await build({
  entryPoints: { app: 'page/main.js', style: 'page/style.css' },
  bundle: true,
  minify: true,
  write: false,
  outdir: 'out',
  format: 'esm',
  target: ['es2022'],
  legalComments: 'inline',
  metafile: true,
});
const textOf = (name) => bundled.outputFiles.find((file) => file.path.endsWith(name)).contents;

/** The licences of the packages that the bundle was made of, found by its inputs: none can be forgotten. */
function licences() {
  const packages = Object.keys(bundled.metafile.inputs)
    .map((input) => /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(input)?.[1])
    .filter(Boolean);
  return [...new Set(packages)].sort().map((name) => {
    const folder = `node_modules/${name}`;
    const { version } = JSON.parse(readFileSync(`${folder}/package.json`, 'utf8'));
    const file = ['LICENSE', 'LICENSE.md', 'LICENSE.txt', 'LICENCE'].map((leaf) => `${folder}/${leaf}`).find(existsSync);
    if (!file) throw new Error(`${folder}: no licence file; what is served has to carry it`);
    return `${name} ${version}\n\n${readFileSync(file, 'utf8').trim()}\n`;
  });
}
const rule = `\n${'-'.repeat(72)}\n\n`;
const notices = [`DisFlow\n\n${readFileSync('../../LICENSE', 'utf8').trim()}\n`, ...licences()].join(rule);
writeFileSync(licencesOutput, notices);

const files = [
  ['/', 'text/html; charset=utf-8', readFileSync('page/index.html')],
  ['/app.js', 'text/javascript; charset=utf-8', textOf('app.js')],
  ['/style.css', 'text/css; charset=utf-8', textOf('style.css')],
  ['/icon.svg', 'image/svg+xml', readFileSync('page/icon.svg')],
  ['/licences.txt', 'text/plain; charset=utf-8', notices],
];

let source = '// Made by apps/view/build.mjs.\n#include "view_page.h"\n\n#include <array>\n\n';
source += 'namespace disflow::apps {\nnamespace {\n\n';
const entries = files.map(([path, type, content], index) => {
  const bytes = gzipSync(content, { level: 9 });
  source += `constexpr std::uint8_t kFile${index}[] = {${[...bytes].join(',')}};\n`;
  return `    posix::WebAsset{"${path}", "${type}", kFile${index}},\n`;
});
source += `\nconstexpr std::array kFiles = {\n${entries.join('')}};\n\n}  // namespace\n\n`;
source += 'std::span<const posix::WebAsset> ViewPage() noexcept { return kFiles; }\n\n';
source += '}  // namespace disflow::apps\n';
writeFileSync(output, source);
