// Bundles page/ into bundle.js and bundle.css (npm ci && npm run build). The first line of bundle.js holds the hash of
// what it was made from, so that a test can tell without npm whether the bundle is of these sources.
import { createHash } from 'node:crypto';
import { readFileSync, readdirSync } from 'node:fs';
import { build } from 'esbuild';

const hash = createHash('sha256');
for (const name of readdirSync('page').sort()) hash.update(readFileSync(`page/${name}`));
for (const name of ['build.mjs', 'package-lock.json']) hash.update(readFileSync(name));

await build({
  entryPoints: ['page/main.js'],
  outfile: 'bundle.js',
  bundle: true,
  minify: true,
  format: 'iife',
  target: 'es2020',
  charset: 'utf8',
  legalComments: 'eof',
  banner: { js: `// sources ${hash.digest('hex')}` },
});
