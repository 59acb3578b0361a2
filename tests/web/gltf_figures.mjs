// What a region of a baked project is as glTF: bytes, triangles, and how far three.js's frame of it is from the truth. A
// measurement for docs/gltf.md, no test.
// usage: gltf_figures.mjs ACENTRIC PROJECT WEB_FOLDER WORK_FOLDER CHROMIUM REGION X,Y YAW_DEGREES
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { openModels } from './models.mjs';
import { pngReader, psnr, ssim } from './pictures.mjs';

const [program, project, web, work, executablePath, region, at, yaw] = process.argv.slice(2);
const { chromium } = createRequire(join(web, 'package.json'))('playwright-core');
const readPng = pngReader(web), kWidth = 1280, kHeight = 720;
const acentric = (...options) => JSON.parse(execFileSync(program, [...options, '--json'], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'inherit'] }));
mkdirSync(work, { recursive: true });

const lean = ['--mesh-compression', 'meshopt', '--texture-format', 'webp'];
const kinds = { plain: [], lean, lossless: [...lean, '--colour-quality', '100'] }, reports = {};
for (const [kind, options] of Object.entries(kinds)) reports[kind] = acentric('export', project, join(work, kind), '--to', 'gltf', '--region', region, ...options);
const { storey, storeys } = JSON.parse(readFileSync(join(work, 'plain', 'walk.json'), 'utf8'));
const { floorHeight, eyeHeight, regions: [{ file }] } = storeys[storey], eye = [...at.split(',').map(Number), floorHeight + eyeHeight];

const render = (name, ...options) => {
  const picture = join(work, `${name}.png`);
  acentric('render', project, `--eye=${eye.join(',')}`, '--yaw', yaw, '--fov', '60', '--size', `${kWidth}x${kHeight}`, '-o', picture, ...options);
  return readPng(readFileSync(picture));
};
const truth = render('truth', '--renderer', 'truth', '--truth-samples', '16'), command = render('command');
const compare = (name, picture) => console.log(`${name}: ${psnr(picture, truth).toFixed(2)} dB from the truth, SSIM ${ssim(picture, truth).toFixed(3)}; ${psnr(picture, command).toFixed(2)} dB from acentric render`);
compare('acentric render', command);

const browser = await chromium.launch({ executablePath, args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'] });
const { page, close } = await openModels(browser, web, 'gltf.html', Object.fromEntries(Object.keys(kinds).map((kind) => [`/${kind}/`, join(work, kind)])));
let plain;
for (const [kind, { bytes, patches, triangles, localTriangles }] of Object.entries(reports)) {
  const address = await page.evaluate((all) => window.draw(...all), [`/${kind}/${file}`, eye, (Number(yaw) * Math.PI) / 180, Math.PI / 3, kWidth, kHeight]);
  const png = Buffer.from(address.split(',')[1], 'base64'), picture = readPng(png);
  writeFileSync(join(work, `${kind}.png`), png);
  plain ??= picture;
  console.log(`${kind}: ${(bytes / 1e6).toFixed(1)} MB, ${patches} patches in ${triangles} triangles, ${localTriangles} near; ${psnr(picture, plain).toFixed(1)} dB from plain`);
  compare(kind, picture);
}
await close();
await browser.close();
