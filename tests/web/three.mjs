// What a walk in a scene of three.js must do: the example of web/three, and the package itself, in a real browser.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { psnr } from './pictures.mjs';

const kWidth = 640, kHeight = 360;

/** In the page: the example's objects, and what tests do with them. */
async function prepare() {
  const THREE = await import('three');
  const { renderer, scene, camera, walk } = window;
  const own = scene.children.filter((object) => object.isMesh);
  const tools = {
    THREE, own,
    /** From a place of the walk, angles in radians; `fov`: degrees, of the picture's longer side. */
    look([x, y, z], yaw, pitch, fov = 60) {
      camera.fov = (360 / Math.PI) * Math.atan(Math.tan((fov * Math.PI) / 360) / camera.aspect);
      camera.updateProjectionMatrix();
      camera.position.set(x, z, -y);
      camera.rotation.set(pitch, yaw - Math.PI / 2, 0);
      renderer.render(scene, camera);
    },
    picture(by = camera) {
      renderer.render(scene, by);
      return renderer.domElement.toDataURL('image/png');
    },
    /** Per unit along the axis of the camera, row by row from the top; by the depth buffer that the scene leaves. */
    depths() {
      const { width, height } = renderer.domElement, depthTexture = new THREE.DepthTexture(width, height, THREE.FloatType);
      const target = new THREE.WebGLRenderTarget(width, height, { depthTexture }), read = new THREE.WebGLRenderTarget(width, height, { type: THREE.FloatType });
      const material = new THREE.ShaderMaterial({
        uniforms: { depths: { value: depthTexture } }, depthTest: false,
        vertexShader: 'void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }',
        fragmentShader: 'uniform highp sampler2D depths; void main() { gl_FragColor = texelFetch(depths, ivec2(gl_FragCoord.xy), 0); }',
      });
      const quad = new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material), { near, far } = camera, values = new Float32Array(4 * width * height);
      quad.frustumCulled = false;
      renderer.setRenderTarget(target);
      renderer.render(scene, camera);
      renderer.setRenderTarget(read);
      renderer.render(quad, camera);
      renderer.setRenderTarget(null);
      renderer.readRenderTargetPixels(read, 0, 0, width, height, values);
      for (const used of [target, read, depthTexture, material, quad.geometry]) used.dispose();
      return (x, y) => (near * far) / (far - values[4 * ((height - 1 - y) * width + x)] * (far - near));
    },
    box(colour, size, place) {
      const box = new THREE.Mesh(new THREE.BoxGeometry(size, size, size), new THREE.MeshBasicMaterial({ color: colour, toneMapped: false }));
      box.position.copy(place);
      scene.add(box);
      return box;
    },
    /** Puts a walk into a scene, which is drawn whenever something of it has come, but once for all of a frame. */
    show(walk, into = scene, by = renderer, from = camera) {
      const draw = () => by.render(into, from);
      let asked = 0;
      walk.addEventListener('change', () => {
        cancelAnimationFrame(asked);
        asked = requestAnimationFrame(draw);
      });
      into.add(walk);
      draw();
      window.walk = walk;
    },
    /** So far along the camera's axis through the middle of a pixel. */
    placeAt: (x, y, depth) => {
      const { width, height } = renderer.domElement;
      const ray = new THREE.Vector3((2 * (x + 0.5)) / width - 1, 1 - (2 * (y + 0.5)) / height, 0.5).applyMatrix4(camera.projectionMatrixInverse);
      return ray.multiplyScalar(-depth / ray.z).applyMatrix4(camera.matrixWorld);
    },
  };
  Object.assign(window, { tools });
}

/** In every page, before all else: how many there are of what the graphics card holds. */
function countResources() {
  const live = {}, prototype = WebGL2RenderingContext.prototype;
  for (const kind of ['Texture', 'Buffer', 'Framebuffer', 'Renderbuffer', 'VertexArray', 'Program', 'Shader']) {
    const all = new Set();
    Object.defineProperty(live, kind, { enumerable: true, get: () => all.size });
    const make = prototype[`create${kind}`], drop = prototype[`delete${kind}`];
    prototype[`create${kind}`] = function (...how) {
      const made = make.apply(this, how);
      all.add(made);
      return made;
    };
    prototype[`delete${kind}`] = function (what) {
      all.delete(what);
      return drop.call(this, what);
    };
  }
  window.live = live;
}

const settle = (page) =>
  page.waitForFunction(
    () => {
      if (!window.walk.stats.settled) window.quietSince = performance.now();
      return performance.now() - (window.quietSince ?? 0) > 700;
    },
    undefined,
    { timeout: 180000, polling: 100 },
  );

export async function threeTests({ browser, test, expect, acentric, project, serve, web, work, storey, readPng, pagePicture }) {
  const decoded = (address) => readPng(Buffer.from(address.split(',')[1], 'base64'));
  /** The example on a walk from another host, or what `before` does in its page; `answer(file, response)` may answer for that host. */
  async function open({ walk = 'site/', answer = () => false } = {}) {
    const pages = await serve(web), walks = await serve(work, 0, (request, response) => {
      response.setHeader('Access-Control-Allow-Origin', '*');
      response.setHeader('Access-Control-Allow-Headers', 'Range');
      response.setHeader('Access-Control-Expose-Headers', 'Content-Range');
      if (request.method === 'OPTIONS') response.writeHead(204).end();
      return request.method === 'OPTIONS' || answer(request.url.slice(1), response);
    });
    const context = await browser.newContext({ viewport: { width: kWidth, height: kHeight } }), page = await context.newPage();
    const errors = [], origin = `http://127.0.0.1:${walks.address().port}`;
    page.on('pageerror', (error) => errors.push(error.message));
    page.on('console', (message) => /error|warning/.test(message.type()) && errors.push(message.text()));
    await page.addInitScript(countResources);
    await page.goto(`http://127.0.0.1:${pages.address().port}/three/example/?walk=${origin}/${walk}`);
    const opened = async (quality = 'coarse') => { // which come sooner, and are drawn the same way
      await page.waitForFunction(() => window.walk !== undefined, undefined, { timeout: 60000 });
      await page.evaluate((wanted) => { window.walk.quality = wanted; }, quality);
      await page.evaluate(prepare);
    };
    return { page, errors, origin, opened, close: async () => (await context.close(), pages.close(), walks.close()) };
  }
  const [startX, startY] = storey.start.position, eye = (x, y) => [x, y, storey.eyeZ];
  const look = async (page, ...pose) => {
    await page.evaluate((all) => window.tools.look(...all), pose);
    await settle(page);
  };
  const own = (page, visible) => page.evaluate((shown) => window.tools.own.forEach((object) => (object.visible = shown)), visible);
  const picture = async (page) => decoded(await page.evaluate(() => window.tools.picture()));

  await test('three.js: the example shows the walk as the page does, and its own objects before and behind', async () => {
    const poses = [[eye(startX, startY), 0.09, 0], [eye(startX + 0.3, startY - 0.4), 2.3, 0.15]];
    const { page, errors, opened, close } = await open();
    await opened('full');
    const expected = await pagePicture(poses);
    for (const [n, pose] of poses.entries()) {
      await look(page, ...pose);
      const whole = await picture(page);
      if (n === 0) await page.screenshot({ path: join(work, 'three.png') });
      const alone = decoded(await page.evaluate(() => {
        const { walk, scene, tools } = window;
        walk.visible = false;
        scene.overrideMaterial = new tools.THREE.MeshBasicMaterial(); // white, on black
        const address = tools.picture();
        walk.visible = true;
        scene.overrideMaterial = null;
        return address;
      }));
      let covered = 0, largest = 0;
      for (let i = 0; i < whole.data.length; i += 4) {
        const difference = Math.max(...[0, 1, 2].map((k) => Math.abs(whole.data[i + k] - expected[n].data[i + k])));
        if (alone.data[i] + alone.data[i + 1] + alone.data[i + 2] === 0) largest = Math.max(largest, difference);
        else {
          for (const { data } of [whole, expected[n]]) data.fill(0, i, i + 3);
          ++covered;
        }
      }
      const decibels = psnr(whole, expected[n]);
      console.log(`        ${decibels.toFixed(1)} dB beside the objects, which cover ${covered} pixels; codes differ by at most ${largest}`);
      expect(decibels >= 45 && covered < whole.data.length / 8, `${decibels} dB, ${covered} pixels covered`);
    }
    expect(errors.length === 0, errors.join('; '));
    await close();
  });

  await test('three.js: the depth that a walk writes is that of the scene, and hides and shows boxes by it', async () => {
    const { page, errors, origin, opened, close } = await open();
    await opened('full');
    await own(page, false);
    await page.evaluate(async (address) => {
      const { GLTFLoader } = await import('/node_modules/three/examples/jsm/loaders/GLTFLoader.js');
      const { scene: model } = await new GLTFLoader().loadAsync(address), { THREE } = window.tools;
      model.traverse(({ material }) => {
        if (!material) return;
        material.visible = !(material.transparent || material.transmission > 0); // glass writes no depth
        material.side = THREE.DoubleSide;
      });
      window.model = model;
    }, `${origin}/gallery.glb`);
    for (const pose of [[eye(startX, startY), 0.09, 0], [eye(startX + 0.3, startY - 0.4), 2.3, -0.2]]) {
      await look(page, ...pose);
      const found = await page.evaluate(() => {
        const { walk, scene, model, tools } = window, shown = tools.depths();
        walk.visible = false;
        scene.add(model);
        const traced = tools.depths(), pairs = [];
        scene.remove(model);
        walk.visible = true;
        for (let y = 2; y < 360; y += 4) for (let x = 2; x < 640; x += 4) pairs.push([shown(x, y), traced(x, y), x, y]);
        return pairs;
      });
      const apart = found.map(([depth, traced]) => Math.abs(depth / traced - 1)).sort((a, b) => a - b);
      const [median, most] = [0.5, 0.9].map((share) => apart[Math.floor(share * apart.length)]);
      console.log(`        depths differ from the model's by ${(100 * median).toFixed(3)} %, nine in ten by less than ${(100 * most).toFixed(2)} %`);
      expect(median < 0.002 && most < 0.02, `${median}, ${most}`);
      const alike = found.filter(([depth, traced]) => Math.abs(depth / traced - 1) < 0.005);
      const walls = alike.filter(([, traced]) => traced < 15);
      for (const [, depth, x, y] of [walls[0], walls[walls.length >> 1], walls.at(-1)]) {
        const colours = await page.evaluate(([far, px, py]) => {
          const { tools, renderer } = window, canvas = document.createElement('canvas');
          Object.assign(canvas, { width: 640, height: 360 });
          const context = canvas.getContext('2d', { willReadFrequently: true }), seen = () => {
            tools.picture();
            context.drawImage(renderer.domElement, 0, 0);
            return [...context.getImageData(px, py, 1, 1).data].slice(0, 3);
          };
          const without = seen(), shares = [0.9, 1.1];
          const within = shares.map((share) => {
            const box = tools.box(0x00ff00, 0.02 * far, tools.placeAt(px, py, share * far)), colour = seen();
            box.removeFromParent();
            return colour;
          });
          return [without, ...within];
        }, [depth, x, y]);
        expect(colours[1].join() === '0,255,0', `a box before the wall at ${x}, ${y} is not seen: ${colours[1]}`);
        expect(colours[2].join() === colours[0].join(), `a box behind the wall at ${x}, ${y} is seen: ${colours[2]} where ${colours[0]} was`);
      }
    }
    expect(errors.length === 0, errors.join('; '));
    await close();
  });

  await test('three.js: rolled and shifted cameras, and walks that are moved, turned and scaled, show the same', async () => {
    const { page, errors, opened, close } = await open();
    await opened();
    await own(page, false);
    await look(page, eye(startX, startY), 0.5, 0.1);
    const upright = await picture(page);
    const alike = async (name, least, expected, change) => {
      const shown = decoded(await page.evaluate(change));
      const decibels = psnr(shown, expected);
      console.log(`        ${name}: ${decibels.toFixed(1)} dB`);
      expect(decibels >= least, `${name}: ${decibels} dB`);
    };
    await alike('moved, turned about the vertical and scaled', 50, upright, () => {
      const { walk, camera, tools } = window, { THREE } = tools;
      walk.position.set(40, -3, 12);
      walk.rotation.set(0, 2.2, 0);
      walk.scale.setScalar(3);
      const moved = camera.clone();
      moved.position.copy(walk.localToWorld(camera.position.clone()));
      moved.quaternion.premultiply(walk.quaternion);
      const address = tools.picture(moved);
      walk.position.set(0, 0, 0);
      walk.rotation.set(0, 0, 0);
      walk.scale.setScalar(1);
      return address;
    });
    await alike('tilted', 50, upright, () => {
      const { walk, camera, tools } = window;
      walk.rotation.set(0.5, 0.3, -1);
      const moved = camera.clone();
      moved.position.copy(walk.localToWorld(camera.position.clone()));
      moved.quaternion.premultiply(walk.quaternion);
      const address = tools.picture(moved);
      walk.rotation.set(0, 0, 0);
      return address;
    });
    const around = { ...upright, data: Buffer.alloc(upright.data.length) };
    for (let i = 0; i < upright.data.length; i += 4) upright.data.copy(around.data, upright.data.length - 4 - i, i, i + 4);
    await alike('rolled by half a turn', 45, around, () => {
      const rolled = window.camera.clone();
      rolled.rotateZ(Math.PI);
      return window.tools.picture(rolled);
    });
    // The middle of a larger picture, a little off its axis; and a part of that around a roll.
    const part = (from, { width, height }, sample) => {
      const data = Buffer.alloc(4 * width * height, 255);
      for (let y = 0; y < height; ++y)
        for (let x = 0; x < width; ++x) {
          const [u, v] = sample(x + 0.5, y + 0.5).map((value) => value - 0.5), [left, top] = [Math.floor(u), Math.floor(v)], [a, b] = [u - left, v - top];
          for (let k = 0; k < 3; ++k) {
            const at = (dx, dy) => from.data[4 * ((top + dy) * from.width + left + dx) + k];
            data[4 * (y * width + x) + k] = Math.round((1 - b) * ((1 - a) * at(0, 0) + a * at(1, 0)) + b * ((1 - a) * at(0, 1) + a * at(1, 1)));
          }
        }
      return { width, height, data };
    };
    const size = { width: 200, height: 120 };
    const cut = async (name, least, [left, top], roll) => {
      const [c, s] = [Math.cos(roll), Math.sin(roll)], middle = [left + 100, top + 60];
      const expected = part(upright, size, (x, y) => {
        const [dx, dy] = [middle[0] + x - 100 - 320, middle[1] + y - 60 - 180];
        return [320 + c * dx + s * dy, 180 - s * dx + c * dy];
      });
      const shown = decoded(await page.evaluate(([x, y, angle, { width, height }]) => {
        const { renderer, camera, tools } = window, seen = camera.clone();
        seen.rotateZ(angle);
        seen.setViewOffset(640, 360, x, y, width, height);
        renderer.setSize(width, height, false);
        const address = tools.picture(seen);
        renderer.setSize(640, 360, false);
        return address;
      }, [left, top, roll, size]));
      const decibels = psnr(shown, expected);
      console.log(`        ${name}: ${decibels.toFixed(1)} dB`);
      expect(decibels >= least, `${name}: ${decibels} dB`);
    };
    await cut('a part of the picture, off the axis', 30, [330, 70], 0);
    await cut('the middle, rolled', 30, [220, 120], 0.35);
    expect(errors.length === 0, errors.join('; '));
    // What cannot be shown is told, once.
    const told = await page.evaluate(() => {
      const { walk, tools } = window, reasons = [];
      walk.addEventListener('error', ({ file, reason }) => reasons.push(`${file}: ${reason}`));
      walk.scale.set(1, 2, 1);
      tools.picture();
      tools.picture();
      walk.scale.set(1, 1, 1);
      tools.picture(new tools.THREE.OrthographicCamera());
      return reasons;
    });
    expect(told.length === 2 && told[0].includes('scale') && told[1].includes('perspective'), told.join('; '));
    await close();
  });

  await test('three.js: drawing leaves the state of the renderer as it was, and dispose gives everything back', async () => {
    const { page, errors, origin, opened, close } = await open();
    await opened();
    await look(page, eye(startX, startY), 0.09, 0);
    // The middle of the red box: the same pixels with the walk around it as without.
    const within = () => page.evaluate(() => {
      const { renderer, camera, scene, tools } = window, canvas = document.createElement('canvas');
      const at = scene.getObjectByName('before').position.clone().project(camera), place = [320 * (1 + at.x), 180 * (1 - at.y)].map(Math.round);
      Object.assign(canvas, { width: 640, height: 360 });
      tools.picture();
      const context = canvas.getContext('2d', { willReadFrequently: true });
      context.drawImage(renderer.domElement, 0, 0);
      return [...context.getImageData(place[0] - 8, place[1] - 8, 16, 16).data].join();
    });
    const shown = await within();
    await page.evaluate(() => window.walk.dispose());
    const alone = await picture(page), before = await page.evaluate(() => ({ ...window.live }));
    expect((await within()) === shown, 'the box looks otherwise beside the walk');
    await page.evaluate(async (address) => {
      const { AcentricWalk } = await import('acentric-three');
      window.tools.show(await AcentricWalk.open(address, window.renderer, { memory: 64, threads: 2, quality: 'coarse' }));
    }, `${origin}/site/`);
    await settle(page);
    const used = await page.evaluate(() => ({ ...window.live }));
    expect(used.Texture > before.Texture + 10 && (await within()) === shown, `not drawn: ${JSON.stringify(used)}`);
    await page.evaluate(() => window.walk.dispose());
    const after = await picture(page), left = await page.evaluate(() => ({ ...window.live }));
    console.log(`        with a walk ${JSON.stringify(used)}, without ${JSON.stringify(left)}`);
    expect(JSON.stringify(left) === JSON.stringify(before), `${JSON.stringify(left)} are left, of ${JSON.stringify(before)}`);
    expect(psnr(after, alone) > 90, 'the scene looks otherwise after the walk');
    expect(errors.length === 0, errors.join('; '));
    await close();
  });

  await test('three.js: logarithmic and reversed depth, and a lost graphics card', async () => {
    const { page, errors, origin, opened, close } = await open();
    await opened();
    await own(page, false);
    await look(page, eye(startX, startY), 0.09, 0);
    const expected = await picture(page);
    for (const options of [{ logarithmicDepthBuffer: true }, { reversedDepthBuffer: true }]) {
      await page.evaluate(async ([address, how]) => {
        const { AcentricWalk } = await import('acentric-three'), { THREE, box, placeAt, show } = window.tools;
        const renderer = new THREE.WebGLRenderer(how);
        renderer.setSize(640, 360, false);
        const scene = new THREE.Scene(), camera = window.camera.clone();
        const boxes = [box(0x00ff00, 0.1, placeAt(200, 240, 1)), box(0x0000ff, 2, placeAt(120, 100, 40))];
        scene.add(...boxes);
        show(await AcentricWalk.open(address, renderer, { quality: 'coarse' }), scene, renderer, camera);
        Object.assign(window, { other: () => (renderer.render(scene, camera), renderer.domElement.toDataURL()) });
      }, [`${origin}/site/`, options]);
      await settle(page);
      const shown = decoded(await page.evaluate(() => window.other())), at = (x, y) => [0, 1, 2].map((k) => shown.data[4 * (y * kWidth + x) + k]);
      expect(at(200, 240).join() === '0,255,0', `${JSON.stringify(options)}: the box before is ${at(200, 240)}`);
      for (let y = 200; y < 280; ++y) for (let x = 160; x < 240; ++x) for (const { data } of [shown, expected]) data.fill(0, 4 * (y * kWidth + x), 4 * (y * kWidth + x) + 3);
      const decibels = psnr(shown, expected);
      console.log(`        ${JSON.stringify(options)}: ${decibels.toFixed(1)} dB`);
      expect(decibels >= 45, `${JSON.stringify(options)}: ${decibels} dB`); // the box behind is hidden
      await page.evaluate(() => window.walk.dispose());
    }
    expect(errors.length === 0, errors.join('; '));
    await page.evaluate(async (address) => {
      const { AcentricWalk } = await import('acentric-three');
      window.tools.show(await AcentricWalk.open(address, window.renderer, { quality: 'coarse' }));
      window.lose = window.renderer.getContext().getExtension('WEBGL_lose_context');
    }, `${origin}/site/`);
    await settle(page);
    await page.evaluate(() => window.lose.loseContext());
    await page.waitForTimeout(200);
    await page.evaluate(() => window.lose.restoreContext());
    await page.waitForFunction(() => window.walk.stats.width > 0, undefined, { timeout: 60000 });
    await settle(page);
    const restored = await picture(page);
    for (let y = 200; y < 280; ++y) for (let x = 160; x < 240; ++x) restored.data.fill(0, 4 * (y * kWidth + x), 4 * (y * kWidth + x) + 3);
    expect(psnr(restored, expected) >= 45, `after the graphics card came back: ${psnr(restored, expected)} dB`);
    await close();
  });

  await test('three.js: a walk of one file is walked in, and what is missing or damaged is named', async () => {
    acentric('export', project, join(work, 'three.acentric'), '--to', 'walk', '--regions-per-page', '4');
    let damaged;
    const { page, errors, origin, opened, close } = await open({
      walk: 'three.acentric',
      answer: (file, response) => {
        if (!file.startsWith('site/coarse/')) return false;
        damaged ??= file.slice('site/'.length);
        if (file !== `site/${damaged}`) return false;
        const bytes = readFileSync(join(work, file));
        bytes[bytes.length >> 1] ^= 1;
        response.writeHead(200, { 'Content-Length': bytes.length }).end(bytes);
        return true;
      },
    });
    await opened();
    await settle(page);
    const walked = await page.evaluate(() => {
      const { walk, camera, tools } = window, { Vector3 } = tools.THREE, { position } = walk.start();
      const outside = walk.clampToWalk(new Vector3(300, 9, 5)), wall = walk.moveWithin(position, position.clone().add(new Vector3(-100, 0, 0)));
      const shown = walk.stats.region;
      camera.position.set(300, 1.6, 0);
      tools.picture();
      return { outside: outside.toArray(), wall: wall.toArray(), shown, region: walk.stats.region, size: walk.stats.width };
    });
    expect(walked.shown >= 0 && walked.region === -1 && walked.size === kWidth, JSON.stringify(walked));
    expect(Math.abs(walked.outside[1] - storey.eyeZ) < 1e-6 && walked.outside[0] < 20, JSON.stringify(walked));
    expect(walked.wall[0] > -8 && walked.wall[0] < -5, JSON.stringify(walked));
    const messages = await page.evaluate(async (at) => {
      const { AcentricWalk } = await import('acentric-three');
      const reason = (url) => AcentricWalk.open(url, window.renderer).then(() => 'opened', (error) => error.message);
      return Promise.all(['none/', 'none.acentric', 'gallery.glb'].map((name) => reason(`${at}/${name}`)));
    }, origin);
    console.log(`        ${messages.join('\n        ')}`);
    ['none/', 'none.acentric', 'gallery.glb'].forEach((name, n) => expect(messages[n].includes(`${origin}/${name}`) && messages[n] !== 'opened', messages[n]));
    errors.length = 0; // the browser tells of what is missing, too
    await page.evaluate(async (address) => {
      const { AcentricWalk } = await import('acentric-three');
      window.walk.dispose();
      const walk = await AcentricWalk.open(address, window.renderer, { quality: 'coarse' });
      window.told = [];
      walk.addEventListener('error', ({ file, reason }) => window.told.push(`${file}: ${reason}`));
      window.camera.position.copy(walk.start().position);
      window.tools.show(walk);
    }, `${origin}/site/`);
    await settle(page);
    const { told, missing } = await page.evaluate(() => ({ told: window.told, missing: window.walk.stats.missing }));
    expect(told.length === 1 && told[0].startsWith(damaged) && told[0].includes('damaged') && missing === 0, `${told.join('; ')}, ${missing} missing`);
    expect(errors.length === 0, errors.join('; '));
    await close();
  });
}
