// Walks as models in programs of others: glTF and 3D Tiles in three.js.
import { readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { blackShare, psnr, ssim } from './pictures.mjs';
import { serve } from './serve.mjs';

const here = fileURLToPath(new URL('.', import.meta.url));
const kTypes = { '.html': 'text/html', '.js': 'text/javascript', '.json': 'application/json' };

/** `name` (gltf.html) of this folder in a page of its own, with packages below /web/, examples, and the folders of `places` ({ '/gltf/': FOLDER }). */
export async function openModels(browser, web, name, places) {
  const all = { '/web/': join(web, 'node_modules'), '/examples/': join(here, '..', '..', 'examples'), '/tests/': here, ...places };
  const requests = [], problems = [];
  const server = await serve(here, 0, (request, response) => {
    const path = new URL(request.url, 'http://localhost').pathname;
    const place = Object.keys(all).find((start) => path.startsWith(start));
    if (!place) {
      response.writeHead(path === '/favicon.ico' ? 204 : 404).end();
      return true;
    }
    response.writeHead(200, { 'Content-Type': kTypes[extname(path)] ?? 'application/octet-stream' }).end(readFileSync(join(all[place], path.slice(place.length))));
    requests.push(path);
    return true;
  });
  const context = await browser.newContext();
  const page = await context.newPage();
  page.on('pageerror', (error) => problems.push(error.message));
  page.on('console', (message) => ['warning', 'error'].includes(message.type()) && !message.text().includes('GL Driver Message') && problems.push(message.text()));
  await page.goto(`http://127.0.0.1:${server.address().port}/tests/${name}`);
  await page.waitForFunction(() => window.draw !== undefined).catch((error) => {
    throw new Error(`${name} does not start: ${problems.join('; ')}`, { cause: error });
  });
  return {
    page, requests, problems,
    close: async () => {
      await context.close();
      server.close();
    },
  };
}

/** The region of a bundle's storey that a point of the plan is in. */
export function regionAt({ regions }, [x, y]) {
  return regions.findIndex(({ polygon }) =>
    polygon.every(([px, py], k) => {
      const [qx, qy] = polygon[(k + 1) % polygon.length];
      return (qx - px) * (y - py) - (qy - py) * (x - px) >= 0;
    }),
  );
}

export async function testModels({ test, expect, browser, acentric, project, web, work, storey, readPng }) {
  const packages = createRequire(join(web, 'package.json'));
  const emptied = (name) => {
    rmSync(join(work, name), { recursive: true, force: true });
    return join(work, name);
  };
  const pictureOf = (address) => readPng(Buffer.from(address.split(',')[1], 'base64'));
  const kWidth = 120, kHeight = 68, kFov = 60; // as fine as captures
  /** As the command draws it. */
  const commandsPicture = (eye, yaw, of = project) => {
    const file = join(work, 'models-command.png');
    acentric(
      'render', of, '--eye', eye.join(','), '--yaw', String(yaw), '--fov', String(kFov), '--size', `${kWidth}x${kHeight}`,
      '--reconstruction', 'patches', '-o', file,
    );
    return readPng(readFileSync(file));
  };

  await test('a region as glTF is valid, plain and lean, and three.js shows what the command shows', async () => {
    const [x, y] = storey.start.position, region = regionAt(storey, [x, y]);
    const lean = ['--mesh-compression', 'meshopt', '--texture-format', 'webp'];
    const kinds = { gltf: [], 'gltf-lean': lean, 'gltf-lossless': [...lean, '--colour-quality', '100'] }, files = {}, sizes = {};
    let walk;
    for (const [name, options] of Object.entries(kinds)) {
      const folder = emptied(name);
      acentric('export', project, folder, '--to', 'gltf', '--region', String(region), ...options);
      walk = JSON.parse(readFileSync(join(folder, 'walk.json'), 'utf8'));
      const [{ file, bytes }] = walk.storeys[walk.storey].regions;
      files[name] = `/${name}/${file}`, sizes[name] = bytes;
      const { issues } = await packages('gltf-validator').validateBytes(new Uint8Array(readFileSync(join(folder, file))));
      console.log(`        ${name}, region ${region}: ${(bytes / 1e6).toFixed(2)} MB, ${issues.numErrors} errors, ${issues.numWarnings} warnings`);
      expect(issues.numErrors === 0 && issues.numWarnings === 0, JSON.stringify(issues.messages.slice(0, 3)));
    }
    expect(sizes['gltf-lean'] < 0.45 * sizes.gltf, `${sizes['gltf-lean']} bytes are not lean`);

    let refused = false;
    try {
      acentric('export', project, emptied('gltf-refused'), '--to', 'gltf', '--colour-quality', '90');
    } catch {
      refused = true;
    }
    expect(refused, 'PNG is given a quality');

    const { page, problems, close } = await openModels(browser, web, 'gltf.html', Object.fromEntries(Object.keys(kinds).map((name) => [`/${name}/`, join(work, name)])));
    const { eyeHeight, floorHeight } = walk.storeys[walk.storey], eye = [x, y, floorHeight + eyeHeight];
    for (const yaw of [65, 125, 245]) { // past the glass case
      const drawn = {};
      for (const [name, file] of Object.entries(files))
        drawn[name] = pictureOf(await page.evaluate((all) => window.draw(...all), [file, eye, (yaw * Math.PI) / 180, (kFov * Math.PI) / 180, kWidth, kHeight]));
      const command = commandsPicture(eye, yaw);
      const decibels = psnr(drawn.gltf, command), likeness = ssim(drawn.gltf, command);
      const leaner = psnr(drawn['gltf-lean'], drawn.gltf), lossless = psnr(drawn['gltf-lossless'], drawn.gltf);
      console.log(
        `        towards ${yaw} degrees: ${decibels.toFixed(1)} dB, SSIM ${likeness.toFixed(3)}; lean ${leaner.toFixed(1)} dB from plain, with every bit of colours ${lossless.toFixed(1)}`,
      );
      expect(decibels > 23 && likeness > 0.8, `${decibels} dB, SSIM ${likeness}`);
      expect(leaner > 33 && lossless > 37, `lean ${leaner} dB, lossless ${lossless} dB`); // masks are cut off elsewhere by rounding
    }
    expect(problems.length === 0, problems.join('; '));
    await close();
  });

  await test('a walk as 3D Tiles shows the region that the eye is in', async () => {
    // A corner of the walk: each region takes ten seconds to export.
    const corner = join(work, 'corner.acentric.json'), part = JSON.parse(readFileSync(project, 'utf8')), { layout } = part.storeys[0];
    Object.assign(layout, { outline: [[[-5.6, -1.1], [-1.2, -1.1], [-1.2, 1.1], [-5.6, 1.1]]], removed: [], freeApvs: [] });
    writeFileSync(corner, JSON.stringify(part));
    acentric('bake', corner);
    const folder = emptied('tiles');
    acentric('export', corner, folder, '--to', '3dtiles');
    const { extras, root } = JSON.parse(readFileSync(join(folder, 'tileset.json'), 'utf8'));
    const { eyeHeight, floorHeight } = extras.storeys[extras.storey];
    for (const { content } of root.children.slice(0, 2)) {
      const { issues } = await packages('gltf-validator').validateBytes(new Uint8Array(readFileSync(join(folder, content.uri))));
      expect(issues.numErrors === 0 && issues.numWarnings === 0, JSON.stringify(issues.messages.slice(0, 3)));
    }
    const { page, requests, problems, close } = await openModels(browser, web, 'tiles.html', { '/tiles/': folder });
    await page.evaluate(() => window.load('/tiles/tileset.json'));
    const holding = (eye) => // the regions in whose volume the viewer stands
      root.children
        .filter(({ viewerRequestVolume: { box } }) =>
          [3, 6, 9].every((axis) => {
            const half = box.slice(axis, axis + 3), along = half.reduce((sum, h, k) => sum + h * (eye[k] - box[k]), 0);
            return Math.abs(along) <= half.reduce((sum, h) => sum + h * h, 0);
          }),
        )
        .map(({ extras: { region } }) => region);
    /** Where only this region's volume holds the eye. */
    const alone = (region) => {
      const { polygon } = root.children.find((tile) => tile.extras.region === region).extras, steps = [0.5, 0.3, 0.7, 0.2, 0.8];
      const places = steps.flatMap((u) => steps.map((v) => [0, 1].map((k) => polygon[0][k] + u * (polygon[1][k] - polygon[0][k]) + v * (polygon.at(-1)[k] - polygon[0][k]))));
      return places.map(([px, py]) => [px, py, floorHeight + eyeHeight]).find((eye) => holding(eye).join() === String(region));
    };
    const fetched = () => requests.filter((path) => path.endsWith('.glb')), fileOf = (region) => `regions/${extras.storey}-${region}.glb`;
    const look = (eye, yaw) => page.evaluate((all) => window.draw(...all), [eye, (yaw * Math.PI) / 180, (kFov * Math.PI) / 180, kWidth, kHeight]);
    const regions = root.children.map(({ extras: { region } }) => region).filter(alone);
    expect(regions.length >= 2, `${root.children.length} regions`);
    const [start, next] = regions;
    for (const [step, [region, yaw]] of [[start, 125], [next, 40], [start, 125]].entries()) { // past mirrors
      const eye = alone(region), { address, shown } = await look(eye, yaw), drawn = pictureOf(address);
      const decibels = psnr(drawn, commandsPicture(eye, yaw, corner));
      console.log(`        in region ${region}: ${shown}, ${decibels.toFixed(1)} dB from the command, ${fetched().length} files read`);
      expect(shown.join() === fileOf(region), `region ${region} shows ${shown}`);
      expect(fetched().length === Math.min(step + 1, 2), `read ${fetched()}`);
      expect(decibels > 19 && blackShare(drawn) < 0.05, `${decibels} dB, ${blackShare(drawn)} of it black`);
    }
    const { shown } = await look([100, 100, 1.6], 0);
    expect(shown.length === 0, `outside of all regions it shows ${shown}`);
    const told = problems.filter((text) => !text.includes('limited support')); // of 3D Tiles 1.1
    expect(told.length === 0, told.join('; ')); // also what TilesetValidationPlugin finds outside of bounding volumes
    await close();
  });
}
