// What the page must do in a real browser. usage: browser.mjs ACENTRIC PROJECT WEB_FOLDER WORK_FOLDER CHROMIUM [PART_OF_A_NAME]
// WORK_FOLDER/site is the project, exported with --to web; site-lossless the same with every bit of its colours.
import { execFileSync } from 'node:child_process';
import { readFileSync, statSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { testModels } from './models.mjs';
import { blackShare, pngReader, psnr, ssim } from './pictures.mjs';
import { serve } from './serve.mjs';
import { threeTests } from './three.mjs';

const [program, project, web, work, executablePath, only = ''] = process.argv.slice(2);
const packages = createRequire(join(web, 'package.json'));
const { chromium } = packages('playwright-core');
const readPng = pngReader(web);
const acentric = (...options) => execFileSync(program, options, { encoding: 'utf8', stdio: ['ignore', 'pipe', 'inherit'] });
const index = JSON.parse(readFileSync(join(work, 'site', 'bundle.json'), 'utf8'));
const storey = index.storeys[index.storey];

const browser = await chromium.launch({
  executablePath,
  args: [
    '--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-quic', '--no-first-run',
    '--disable-background-networking', '--disable-component-update', '--disable-sync',
  ],
});

/** A page on the site, served below a path of its own; `answer(file, response)` may answer for it. */
async function open({ width = 640, height = 360, answer = () => false, before = () => undefined, hash = '', site = 'site', device = {} } = {}) {
  const base = '/some/where/';
  const server = await serve(work, 0, (request, response) => {
    if (!request.url.startsWith(base)) {
      response.writeHead(404).end();
      return true;
    }
    const file = request.url.slice(base.length).split('?')[0];
    if (answer(file, response)) return true;
    request.url = `/${site}/${file}`;
    return false;
  });
  const origin = `http://127.0.0.1:${server.address().port}`;
  const context = await browser.newContext({ viewport: { width, height }, ...device });
  const page = await context.newPage();
  const requests = [], errors = [];
  page.on('request', (request) => requests.push(request.url()));
  page.on('pageerror', (error) => errors.push(error.message));
  page.on('console', (message) => message.text().includes('Content Security Policy') && errors.push(message.text()));
  await page.addInitScript(before);
  await page.goto(`${origin}${base}${hash}`);
  return {
    page, requests, errors, origin,
    close: async () => {
      await context.close();
      server.close();
    },
  };
}

const started = (page) => page.waitForFunction(() => window.acentric?.firstPicture !== undefined, undefined, { timeout: 120000 });
/** Until all that is worth having here has come. */
const settled = (page) =>
  page.waitForFunction(
    () => {
      const walk = window.acentric;
      if (!walk.resting || walk.facts.captures.length === 0) window.quietSince = performance.now();
      return performance.now() - (window.quietSince ?? 0) > 700;
    },
    undefined,
    { timeout: 180000, polling: 100 },
  );
async function picture(page) {
  const { address, took } = await page.evaluate(() => window.acentric.picture());
  return { png: readPng(Buffer.from(address.split(',')[1], 'base64')), took };
}
const go = (page, [x, y], yaw, pitch = 0) => page.evaluate(([px, py, a, b]) => window.acentric.go({ eye: [px, py, 0], yaw: a, pitch: b }), [x, y, yaw, pitch]);

let failed = 0;
async function test(name, body) {
  if (!name.includes(only)) return;
  const began = Date.now();
  try {
    await body();
    console.log(`ok      ${name} (${((Date.now() - began) / 1000).toFixed(1)} s)`);
  } catch (error) {
    ++failed;
    console.log(`FAILED  ${name}: ${error.stack ?? error}`);
  }
}
function expect(condition, message) {
  if (!condition) throw new Error(message);
}

await test('the first picture comes soon, and nothing leaves the origin', async () => {
  const { page, requests, errors, origin, close } = await open({ width: 1280, height: 720 });
  await started(page);
  const milliseconds = await page.evaluate(() => window.acentric.firstPicture);
  console.log(`        first picture after ${Math.round(milliseconds)} ms, ${requests.length} requests`);
  expect(milliseconds < 90000, `the first picture took ${milliseconds} ms`); // less than 2 s on a quiet machine
  await settled(page);
  const { png, took } = await picture(page);
  const patches = await page.evaluate(() => window.acentric.facts.patches);
  console.log(`        a frame of 1280x720: ${Math.round(took)} ms with its reading back, ${patches} patches`);
  expect(blackShare(png) < 0.01, `${blackShare(png)} of the first picture is black`);
  expect(requests.every((url) => url.startsWith(origin) || url.startsWith('data:') || url.startsWith('blob:')), `requests left: ${requests}`);
  expect(errors.length === 0, errors.join('; '));
  await close();
});

await test('frames are those of the command', async () => {
  const { page, close } = await open({ site: 'site-lossless' });
  await started(page);
  await page.evaluate(() => {
    Object.assign(window.acentric.settings, { fov: 60, scale: 1 });
    window.acentric.settingsChanged();
  });
  const [x, y] = storey.start.position;
  const poses = [[[x, y], 5, 0], [[x, y], 95, 0], [[3.1, -2.4], 130, 0], [[-3.4, 2.9], -60, 10], [[1.2, 3.2], 200, -15]];
  for (const [at, yaw, pitch] of poses) {
    await go(page, at, (yaw * Math.PI) / 180, (pitch * Math.PI) / 180);
    await settled(page);
    const eye = await page.evaluate(() => window.acentric.pose.eye);
    const file = join(work, 'command.png');
    acentric(
      'render', project, '--eye', eye.join(','), '--yaw', String(yaw), '--pitch', String(pitch), '--fov', '60', '--size', '640x360', '-o', file,
    );
    const shown = (await picture(page)).png, rendered = readPng(readFileSync(file));
    const decibels = psnr(shown, rendered);
    console.log(`        at ${at} towards ${yaw} degrees: ${decibels.toFixed(2)} dB, SSIM ${ssim(shown, rendered).toFixed(4)}`);
    expect(decibels >= 45, `${decibels} dB at ${at}, ${yaw} degrees`);
  }
  await close();
});

/** Regions to walk through, each touching the one before: as far as it goes without one twice. */
function wayThroughRegions(first, count) {
  const middle = (n) => [0, 1].map((k) => storey.regions[n].polygon.reduce((sum, p) => sum + p[k], 0) / storey.regions[n].polygon.length);
  const search = (way) => {
    if (way.length === count) return way;
    for (const next of storey.regions[way.at(-1)].neighbours) {
      const found = way.includes(next) ? undefined : search([...way, next]);
      if (found) return found;
    }
    return undefined;
  };
  return search([first]).map(middle);
}

await test('a walk through ten regions shows no blank frame', async () => {
  const { page, close } = await open({ width: 480, height: 270 });
  await started(page);
  // At the page's own pace of a walk on a machine that shows its first picture after two seconds; a slower or busier one
  // walks as much slower.
  const metresPerSecond = 1.4;
  const slower = Math.max(1, (await page.evaluate(() => window.acentric.firstPicture)) / 2000);
  const way = wayThroughRegions(await page.evaluate(() => window.acentric.region), 12);
  const metresTo = (n) => Math.hypot(way[n][0] - way[n - 1][0], way[n][1] - way[n - 1][1]);
  const crossed = new Set();
  let worst = 0, frames = 0;
  for (let n = 1; n < way.length; ++n)
    for (let step = 0; step < 4; ++step) {
      const at = [0, 1].map((k) => way[n - 1][k] + (step / 4) * (way[n][k] - way[n - 1][k]));
      await go(page, at, Math.atan2(way[n][1] - way[n - 1][1], way[n][0] - way[n - 1][0]));
      await page.waitForTimeout((1000 * slower * metresTo(n)) / 4 / metresPerSecond);
      worst = Math.max(worst, blackShare((await picture(page)).png));
      crossed.add(await page.evaluate(() => window.acentric.region));
      ++frames;
    }
  console.log(`        ${frames} frames in ${crossed.size} regions, ${slower.toFixed(1)} times slower than usual, at most ${(100 * worst).toFixed(2)} % black`);
  expect(crossed.size >= 10, `only ${crossed.size} regions`);
  expect(worst < 0.3, `a frame is black in ${worst} of its pixels`);
  await close();
});

await test('a camera that was not baked is told, and the rest is drawn at full size', async () => {
  const partial = structuredClone(index), { storeys, storey: start } = partial;
  const answer = (file, response) => {
    if (file !== 'bundle.json') return false;
    response.writeHead(200, { 'Content-Type': 'application/json' }).end(JSON.stringify(partial));
    return true;
  };
  const whole = await open();
  await started(whole.page);
  const [seen] = await whole.page.evaluate(() => window.acentric.facts.captures);
  await whole.close();
  Object.assign(storeys[start].cameras[seen], { full: null, coarse: null });
  const { page, close } = await open({ answer });
  await started(page);
  await settled(page);
  expect((await page.locator('.message[data-name=unbaked] p').textContent()).includes('not baked'), 'no message');
  const { drawing, missing } = await page.evaluate(() => ({ drawing: window.acentric.drawing, missing: window.acentric.facts.missing }));
  expect(drawing.width === 640 && missing.length === 1 && missing[0] === seen, JSON.stringify({ drawing, missing }));
  await close();
});

await test('missing and damaged files are named, their coarse captures stand in, and asking again heals', async () => {
  let broken = true;
  const spoiled = { missing: undefined, damaged: undefined };
  const { page, close } = await open({
    answer: (file, response) => {
      if (!broken || !file.startsWith('captures/')) return false;
      spoiled.missing ??= file;
      if (spoiled.missing === file) {
        response.writeHead(404).end();
        return true;
      }
      spoiled.damaged ??= file;
      if (spoiled.damaged !== file) return false;
      const bytes = readFileSync(join(work, 'site', file));
      bytes[bytes.length >> 1] ^= 1;
      response.writeHead(200, { 'Content-Length': bytes.length }).end(bytes);
      return true;
    },
  });
  await started(page);
  await settled(page);
  const message = await page.locator('.message[data-name=files] p').textContent();
  expect(message.includes(spoiled.missing) && message.includes('missing') && message.includes('1 more'), message);
  const failures = await page.evaluate(() => [...window.acentric.failures.values()]);
  expect(failures.some(({ file, reason }) => file === spoiled.damaged && reason.includes('damaged')), JSON.stringify(failures));
  const facts = await page.evaluate(() => window.acentric.facts);
  expect(facts.missing.length === 0, 'their coarse captures do not stand in');
  expect(blackShare((await picture(page)).png) < 0.01, 'the picture has holes');
  const before = await page.evaluate(() => window.acentric.pose.eye);
  await page.locator('#view').focus();
  await page.keyboard.down('KeyS');
  const away = ([x, y]) => Math.hypot(window.acentric.pose.eye[0] - x, window.acentric.pose.eye[1] - y) > 0.05;
  await page.waitForFunction(away, before, { timeout: 30000 });
  await page.keyboard.up('KeyS');
  broken = false;
  await page.getByRole('button', { name: 'Try again' }).click();
  await settled(page);
  expect((await page.locator('.message').count()) === 0, 'the message stays');
  expect(await page.evaluate(() => window.acentric.failures.size === 0), 'files stay lost');
  await close();
});

await test('the keyboard alone reaches everything', async () => {
  const { page, close } = await open({ width: 1280, height: 720 });
  await started(page);
  const focus = () => page.evaluate(() => document.activeElement?.id);
  const outline = () => page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle);
  for (const id of ['view', 'tool-map', 'tool-holes', 'tool-settings', 'tool-help']) {
    await page.keyboard.press('Tab');
    expect((await focus()) === id, `Tab leads to ${await focus()} instead of ${id}`);
    expect((await outline()) !== 'none', `no focus ring on ${id}`);
  }
  await page.keyboard.press('Shift+Tab');
  await page.keyboard.press('Enter');
  expect(await page.locator('#settings').isVisible(), 'Enter does not open the settings');
  const seen = new Set();
  for (let n = 0; n < 7; ++n) {
    seen.add(await focus());
    await page.keyboard.press('Tab');
  }
  for (const id of ['set-quality', 'set-scale', 'set-fov', 'set-memory', 'set-view']) expect(seen.has(id), `Tab does not reach ${id}`);
  await page.locator('#set-fov').focus();
  const fov = await page.evaluate(() => window.acentric.settings.fov);
  await page.keyboard.press('ArrowRight');
  expect((await page.evaluate(() => window.acentric.settings.fov)) === fov + 1, 'an arrow does not move a slider');
  await page.keyboard.press('Escape');
  expect(!(await page.locator('#settings').isVisible()), 'Escape does not close the settings');
  const pose = () => page.evaluate(() => window.acentric.pose);
  for (const [key, axis] of [['ArrowLeft', 'yaw'], ['PageUp', 'pitch']]) {
    const start = await pose();
    await page.keyboard.down(key);
    await page.waitForFunction(([name, least]) => window.acentric.pose[name] > least, [axis, start[axis] + 0.05], { timeout: 30000 });
    await page.keyboard.up(key);
  }
  await page.keyboard.press('h');
  expect((await page.locator('#tool-holes').getAttribute('aria-pressed')) === 'true', 'H does not show holes');
  await page.keyboard.press('m');
  expect(!(await page.locator('#map').isVisible()), 'M does not hide the map');
  const labels = await page.evaluate(() =>
    [...document.querySelectorAll('button, input, select, canvas')].filter(
      (e) => !(e.getAttribute('aria-label') || e.textContent.trim() || e.labels?.length),
    ).length,
  );
  expect(labels === 0, `${labels} controls have no label`);
  await close();
});

await test('on a phone it is walked by touch', async () => {
  const { page, close } = await open({ width: 390, height: 700, device: { hasTouch: true, isMobile: true, deviceScaleFactor: 1 } });
  await started(page);
  const pose = () => page.evaluate(() => window.acentric.pose);
  const inside = await page.evaluate(() => {
    const wide = document.documentElement.scrollWidth;
    return { wide, shown: [...document.querySelectorAll('#tools button, #stick button')].map((e) => e.getBoundingClientRect()).map(({ left, right, width }) => ({ left, right, width })) };
  });
  expect(inside.wide <= 390 && inside.shown.every(({ left, right, width }) => left >= 0 && right <= 390 && width >= 30), JSON.stringify(inside));
  const touch = await page.context().newCDPSession(page);
  const send = (type, points) => touch.send('Input.dispatchTouchEvent', { type, touchPoints: points });
  const start = await pose();
  await send('touchStart', [{ x: 200, y: 300 }]);
  await send('touchMove', [{ x: 120, y: 320 }]);
  await send('touchEnd', []);
  const turned = await pose();
  expect(Math.abs(turned.yaw - start.yaw) > 0.05 && turned.eye[0] === start.eye[0], JSON.stringify({ start, turned }));
  const forward = await page.locator('[data-walk=KeyW]').boundingBox();
  await send('touchStart', [{ x: forward.x + forward.width / 2, y: forward.y + forward.height / 2 }]);
  await page.waitForFunction(([x, y]) => Math.hypot(window.acentric.pose.eye[0] - x, window.acentric.pose.eye[1] - y) > 0.05, turned.eye, { timeout: 60000 });
  await send('touchEnd', []);
  await settled(page);
  const still = await pose();
  await page.waitForTimeout(400);
  expect((await pose()).eye[0] === still.eye[0], 'it walks on without a finger');
  await page.screenshot({ path: join(work, 'phone.png') });
  await close();
});

await test('nothing is drawn when nothing changes', async () => {
  const { page, close } = await open();
  await started(page);
  await settled(page);
  const frames = () => page.evaluate(() => window.acentric.framesDrawn);
  const before = await frames();
  await page.waitForTimeout(1500);
  expect((await frames()) === before, `${(await frames()) - before} frames at rest`);
  await close();
});

await test('memory stays within its limit, walks go on', async () => {
  const { page, close } = await open({ width: 480, height: 270 });
  await started(page);
  await page.evaluate(() => {
    window.acentric.settings.memory = 24;
    window.acentric.settingsChanged();
  });
  let most = 0;
  for (const at of wayThroughRegions(await page.evaluate(() => window.acentric.region), 8)) {
    await go(page, at, 1);
    await settled(page);
    most = Math.max(most, await page.evaluate(() => window.acentric.bytes));
    expect(await page.evaluate(() => window.acentric.facts.missing.length === 0), `captures are missing at ${at}`);
  }
  console.log(`        at most ${(most / 1e6).toFixed(1)} MB of 24`);
  expect(most < 26e6, `${most} bytes`);
  await close();
});

await test('a lost graphics card is said and overcome', async () => {
  const { page, close } = await open();
  await started(page);
  await page.evaluate(() => {
    window.lose = document.getElementById('view').getContext('webgl2').getExtension('WEBGL_lose_context');
    window.lose.loseContext();
  });
  await page.locator('.message[data-name=lost]').waitFor();
  await page.evaluate(() => window.lose.restoreContext());
  await page.locator('.message[data-name=lost]').waitFor({ state: 'detached' });
  await settled(page);
  expect(blackShare((await picture(page)).png) < 0.01, 'the picture does not come back');
  await close();
});

await test('without WebGL2 the page says so', async () => {
  const { page, close } = await open({
    before: () => {
      const getContext = HTMLCanvasElement.prototype.getContext;
      HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
        return kind === 'webgl2' ? null : getContext.call(this, kind, ...rest);
      };
    },
  });
  await page.getByRole('alert').waitFor();
  expect((await page.getByRole('alert').textContent()).includes('WebGL2'), 'another message');
  await close();
});

await test('an address leads to a view', async () => {
  const [x, y] = storey.start.position;
  const { page, close } = await open({ hash: `#at=${x},${y},120,-10` });
  await started(page);
  const { yaw, pitch } = await page.evaluate(() => window.acentric.pose);
  expect(Math.abs(yaw - (120 * Math.PI) / 180) < 1e-6 && Math.abs(pitch + (10 * Math.PI) / 180) < 1e-6, `${yaw}, ${pitch}`);
  await close();
});

await test('a walk is one file, read by ranges, page after page of its index', async () => {
  acentric('export', project, join(work, 'site', 'walk.acentric'), '--to', 'walk', '--regions-per-page', '2');
  const bundled = await open();
  await started(bundled.page);
  await settled(bundled.page);
  const expected = (await picture(bundled.page)).png;
  await bundled.close();
  const { page, requests, errors, close } = await open({ hash: '?walk=walk.acentric' });
  await started(page);
  await settled(page);
  expect(psnr((await picture(page)).png, expected) > 60, 'another picture than from the bundle');
  const opened = requests.filter((url) => url.startsWith('http')).map((url) => url.split('/').at(-1));
  expect(opened.every((name) => !/\.(json|pack|local|png)$/.test(name)), opened.join(' '));
  const first = await page.evaluate(() => ({ count: window.acentric.current.regions.length, all: window.acentric.current.regionCount }));
  expect(first.count < first.all, `the page holds ${first.count} of ${first.all} regions`);
  const crossed = new Set();
  for (const at of wayThroughRegions(await page.evaluate(() => window.acentric.current.regions[window.acentric.region].number), 6)) {
    await go(page, at, 1);
    await settled(page);
    const { number, missing } = await page.evaluate(() => {
      const walk = window.acentric;
      return { number: walk.current.regions[walk.region].number, missing: walk.facts.missing.length };
    });
    crossed.add(number);
    expect(missing === 0, `${missing} captures are missing at ${at}`);
    expect(blackShare((await picture(page)).png) < 0.01, `the picture at ${at} has holes`);
  }
  expect(crossed.size === 6, `only ${[...crossed]}`);
  expect(errors.length === 0, errors.join('; '));
  await close();
});

await test('paths are walked along, and a frame around the walk steers it, under a strict policy', async () => {
  const withPath = structuredClone(index), [x, y] = storey.start.position;
  withPath.paths = [{ name: 'tour', storey: index.storey, poses: [0, 1, 2].map((k) => ({ eye: [x + 0.1 * k, y, 1.6], yaw: 0.2 * k, pitch: 0, seconds: 0.4 * k })) }];
  const policy = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; worker-src blob: data:; connect-src 'self' data:; img-src 'self' blob: data:";
  const answer = (file, response) => {
    if (file === 'bundle.json') response.writeHead(200, { 'Content-Type': 'application/json' }).end(JSON.stringify(withPath));
    else if (file === 'outer.html')
      response.writeHead(200, { 'Content-Type': 'text/html' }).end(
        `<iframe src="index.html" width="480" height="270"></iframe><script>told = []; onmessage = ({ data }) => told.push(data);</script>`,
      );
    else if (file === 'index.html' || file === '')
      response.writeHead(200, { 'Content-Type': 'text/html', 'Content-Security-Policy': policy }).end(readFileSync(join(work, 'site', 'index.html')));
    else return false;
    return true;
  };
  const { page, errors, close } = await open({ answer, hash: 'outer.html' });
  const frame = await (await page.waitForSelector('iframe')).contentFrame();
  await frame.waitForFunction(() => window.acentric?.firstPicture !== undefined, undefined, { timeout: 120000 });
  const ready = await page.evaluate(() => window.told.find(({ event }) => event === 'ready'));
  expect(ready?.acentric === 1 && ready.paths[0] === 'tour', JSON.stringify(ready));
  const send = (message) => page.evaluate((it) => document.querySelector('iframe').contentWindow.postMessage({ acentric: 1, ...it }, '*'), message);
  await send({ do: 'play', name: 'tour' });
  await frame.waitForFunction(() => Math.abs(window.acentric.pose.yaw - 0.4) < 1e-6, undefined, { timeout: 60000 });
  await page.waitForFunction(() => window.told.some(({ event, yaw }) => event === 'view' && Math.abs(yaw - (0.4 * 180) / Math.PI) < 1e-3), undefined, { timeout: 60000 });
  await send({ do: 'go', eye: [x, y], yaw: 90, pitch: 5 });
  await frame.waitForFunction(() => Math.abs(window.acentric.pose.yaw - Math.PI / 2) < 1e-6, undefined, { timeout: 60000 });
  await send({ do: 'go', eye: ['a', {}] });
  await send({ do: 'bookmark', name: 'none' });
  expect(errors.length === 0, errors.join('; '));
  expect(await frame.evaluate(() => window.acentric.failures.size === 0), 'files do not come under this policy');
  await close();
});

await test('as a single file it walks from the disk', async () => {
  const file = join(work, 'single.html');
  const report = JSON.parse(acentric('export', project, file, '--to', 'web', '--single-file', '--json'));
  const large = statSync(file).size > 32 * 2 ** 20;
  expect(report.warnings.some((text) => text.includes('MB')) === large, `${statSync(file).size} bytes, warnings ${report.warnings}`);
  const context = await browser.newContext({ viewport: { width: 480, height: 270 } });
  const page = await context.newPage();
  const requests = [];
  page.on('request', (request) => requests.push(request.url()));
  await page.goto(pathToFileURL(file).href, { timeout: 120000 });
  await started(page);
  await settled(page);
  expect(blackShare((await picture(page)).png) < 0.01, 'the picture has holes');
  expect(requests.every((url) => /^(file|data|blob):/.test(url)), `requests left: ${requests.filter((url) => !url.startsWith('data:'))}`);
  await context.close();
});

await testModels({ test, expect, browser, acentric, project, web, work, storey, readPng });

/** The page's own frames of some views: eye, yaw and pitch. */
async function pagePicture(poses) {
  const { page, close } = await open();
  await started(page);
  await page.evaluate(() => {
    Object.assign(window.acentric.settings, { fov: 60, scale: 1 });
    window.acentric.settingsChanged();
  });
  const pictures = [];
  for (const [at, yaw, pitch] of poses) {
    await go(page, at, yaw, pitch);
    await settled(page);
    pictures.push((await picture(page)).png);
  }
  await close();
  return pictures;
}
await threeTests({ browser, test, expect, acentric, project, serve, web, work, storey, readPng, pagePicture });

await browser.close();
console.log(failed === 0 ? 'all passed' : `${failed} failed`);
process.exit(failed === 0 ? 0 : 1);
