import { readFileSync } from 'node:fs';
import { Euler, Matrix4, Object3D, OrthographicCamera, PerspectiveCamera, Quaternion, Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { transform, type Vec3 } from '../src/geometry/vector';
import { pictureFromWorld } from '../src/geometry/view';
import { objectFromWalk, UnsupportedView, viewOfCamera, walkFromObject } from '../three/src/camera_view';

/** Of a camera, and of the object that it is relative to. */
function viewOf(camera: PerspectiveCamera | OrthographicCamera, object = new Object3D(), width = 640, height = 360, resolution = 1) {
  camera.updateProjectionMatrix();
  camera.updateMatrixWorld(true);
  object.updateMatrixWorld(true);
  const objectFromCamera = new Matrix4().multiplyMatrices(camera.matrixWorldInverse, object.matrixWorld).invert();
  return viewOfCamera(objectFromCamera.elements, camera.projectionMatrix.elements, width, height, resolution);
}
/** A camera at a place of the walk that looks along azimuth and elevation, which the object follows. */
function cameraAt(eye: Vec3, yaw: number, pitch: number, object = new Object3D()): PerspectiveCamera {
  const camera = new PerspectiveCamera(36, 640 / 360, 0.1, 100);
  const place = (p: Vec3) => new Vector3(...objectFromWalk(p)).applyMatrix4(object.matrixWorld);
  object.updateMatrixWorld(true);
  camera.position.copy(place(eye));
  camera.up.set(0, 1, 0).transformDirection(object.matrixWorld);
  const c = Math.cos(pitch);
  camera.lookAt(place([eye[0] + c * Math.cos(yaw), eye[1] + c * Math.sin(yaw), eye[2] + Math.sin(pitch)]));
  return camera;
}
/** Where three.js shows a place of the walk, and where the view and what it says of rays do: pixels from the top left, and inverse depths. */
function shown(camera: PerspectiveCamera, object: Object3D, seen: ReturnType<typeof viewOf>, place: Vec3, width = 640, height = 360) {
  const inCamera = new Vector3(...objectFromWalk(place)).applyMatrix4(object.matrixWorld).applyMatrix4(camera.matrixWorldInverse);
  const depth = -inCamera.z, onScreen = inCamera.clone().applyMatrix4(camera.projectionMatrix);
  const { view } = seen, [u, v, w] = transform(pictureFromWorld(view), [place[0] - view.eye[0], place[1] - view.eye[1], place[2] - view.eye[2]]);
  const q = transform(seen.pictureFromRay, [inCamera.x / depth, inCamera.y / depth, -1]);
  return {
    screen: [0.5 * (1 + onScreen.x) * width, 0.5 * (1 - onScreen.y) * height], inView: [u / w, v / w], byRay: [q[0] / q[2], q[1] / q[2]],
    inverse: 1 / depth, inverseByRay: (1 / w) * q[2] * seen.metresPerUnit,
  };
}
const close = (a: readonly number[], b: readonly number[], digits = 6) => a.forEach((value, i) => expect(value).toBeCloseTo(b[i], digits));
const places: Vec3[] = [[6, 3, 1.2], [7, 2.4, 2.5], [5, 3.6, 0.4], [9, 5, 1.7]];
const turned = (angle: number) => new Quaternion().setFromAxisAngle(new Vector3(0, 0, 1), angle);

describe('a camera of three.js', () => {
  it('upright is the view itself, pixel by pixel', () => {
    const camera = cameraAt([1, 2, 1.6], 0.3, -0.1), seen = viewOf(camera), { view } = seen;
    close([...view.eye, view.yaw, view.pitch], [1, 2, 1.6, 0.3, -0.1], 9);
    expect([view.width, view.height]).toEqual([640, 360]);
    for (const place of places) {
      const at = shown(camera, new Object3D(), seen, place);
      close(at.inView, at.screen);
      close(at.byRay, at.screen);
      expect(at.inverseByRay).toBeCloseTo(at.inverse, 9);
    }
  });
  it('sees the same of a walk that is moved, turned anyhow and scaled with it', () => {
    const object = new Object3D();
    object.position.set(30, -4, 7);
    object.quaternion.setFromEuler(new Euler(0.4, -1.1, 0.7));
    object.scale.setScalar(2.5);
    const camera = cameraAt([1, 2, 1.6], 0.3, -0.1, object), seen = viewOf(camera, object), { view } = seen;
    close([...view.eye, view.yaw, view.pitch], [1, 2, 1.6, 0.3, -0.1], 9);
    expect(seen.metresPerUnit).toBeCloseTo(1 / 2.5, 9);
    for (const place of places) {
      const at = shown(camera, object, seen, place);
      close(at.byRay, at.screen);
      expect(at.inverseByRay).toBeCloseTo(at.inverse, 9);
    }
  });
  it('rolled, off its axis, or with oblong pixels lies within its view, which is as fine', () => {
    for (const [roll, offset, height] of [[0.4, 0, 360], [Math.PI / 2, 0, 360], [3, 0, 360], [0, 1, 360], [-0.2, 1, 360], [0, 0, 240]]) {
      const camera = cameraAt([1, 2, 1.6], 0.3, -0.1);
      camera.quaternion.multiply(turned(roll));
      if (offset) camera.setViewOffset(1280, 720, 500, 60, 640, 360);
      const seen = viewOf(camera, new Object3D(), 640, height), { view } = seen;
      for (const place of places) {
        const at = shown(camera, new Object3D(), seen, place, 640, height);
        close(at.byRay, at.inView);
        expect(at.inverseByRay).toBeCloseTo(at.inverse, 9);
      }
      const [corner, other, third, last, middle, beside] = [[0, 0], [640, 0], [0, height], [640, height], [320, 180], [321, 180]].map(([x, y]) => {
        const { elements: p } = camera.projectionMatrix, ndc = [x / 320 - 1, 1 - (2 * y) / height];
        const [u, v, w] = transform(seen.pictureFromRay, [(ndc[0] + p[8]) / p[0], (ndc[1] + p[9]) / p[5], -1]);
        return [u / w, v / w];
      });
      for (const [u, v] of [corner, other, third, last])
        expect(u > -1e-3 && u < view.width + 1e-3 && v > -1e-3 && v < view.height + 1e-3, `${u}, ${v} of ${view.width}, ${view.height}`).toBe(true);
      expect(Math.hypot(beside[0] - middle[0], beside[1] - middle[1])).toBeGreaterThan(0.999);
    }
  });
  it('straight up and down still has a direction that it looks to', () => {
    for (const up of [1, -1]) {
      const camera = new PerspectiveCamera(40, 1);
      camera.quaternion.setFromEuler(new Euler((up * Math.PI) / 2, 0.6, 0, 'YXZ'));
      const { view, pictureFromRay } = viewOf(camera, new Object3D(), 100, 100);
      expect(view.pitch).toBeCloseTo((up * Math.PI) / 2, 6);
      expect([view.width, view.height]).toEqual([100, 100]);
      close([...transform(pictureFromRay, [0, 0.1, -1])], [50, 50 - 0.1 * view.focal, 1], 4);
    }
  });
  it('asks for fewer pixels where told so, and never for more than there may be', () => {
    const camera = cameraAt([0, 0, 1.6], 0, 0);
    expect([0.5, 100].map((resolution) => viewOf(camera, new Object3D(), 640, 360, resolution).view.width)).toEqual([320, 8192]);
  });
  it('is refused where it shows what a walk cannot, with the reason', () => {
    const camera = cameraAt([0, 0, 1.6], 0, 0), stretched = new Object3D(), mirrored = new Object3D();
    stretched.scale.set(1, 2, 1);
    mirrored.scale.set(-1, 1, 1);
    expect(() => viewOf(camera, stretched)).toThrow(/scale/);
    expect(() => viewOf(camera, mirrored)).toThrow(/mirror/);
    expect(() => viewOf(new OrthographicCamera())).toThrow(/perspective/);
    expect(() => viewOf(new PerspectiveCamera(170, 1))).toThrow(UnsupportedView);
  });
  it('has axes that follow glTF', () => {
    expect(objectFromWalk([1, 2, 3])).toEqual([1, 3, -2]);
    expect(walkFromObject(objectFromWalk([1, 2, 3]))).toEqual([1, 2, 3]);
    expect(viewOf(new PerspectiveCamera()).view.yaw).toBeCloseTo(Math.PI / 2, 12); // along -z
  });
});

describe('the package for three.js', () => {
  it('has the version of the project', () => {
    const { version } = JSON.parse(readFileSync(new URL('../three/package.json', import.meta.url), 'utf8')) as { version: string };
    const project = /^project\(Acentric VERSION ([\d.]+)/m.exec(readFileSync(new URL('../../CMakeLists.txt', import.meta.url), 'utf8'));
    expect(version).toBe(project?.[1]);
  });
});
