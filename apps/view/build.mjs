// SPDX-License-Identifier: BSD-3-Clause
// Bundles the page and writes it as a C++ source: node build.mjs OUTPUT.cc
import { readFileSync, writeFileSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import { build } from 'esbuild';

const output = process.argv[2];
if (!output) {
  console.error('usage: node build.mjs OUTPUT.cc');
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
});
const textOf = (name) => bundled.outputFiles.find((file) => file.path.endsWith(name)).contents;

const files = [
  ['/', 'text/html; charset=utf-8', readFileSync('page/index.html')],
  ['/app.js', 'text/javascript; charset=utf-8', textOf('app.js')],
  ['/style.css', 'text/css; charset=utf-8', textOf('style.css')],
  ['/icon.svg', 'image/svg+xml', readFileSync('page/icon.svg')],
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
