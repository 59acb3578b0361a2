/** Draws the walk's picture with its depths into a scene of three.js: a triangle over all that the camera sees, before all else. */

import { Box3, BufferAttribute, BufferGeometry, Matrix3, Mesh, ShaderMaterial, Sphere, Texture, Vector3, type WebGLRenderer } from 'three';
import type { Bundle } from '../../src/bundle/types';
import type { Picture } from '../../src/render/renderer';
import captureDepth from '../../src/render/shaders/capture_depth.glsl?raw';
import colour from '../../../shaders/colour.glsl?raw';
import { objectFromWalk, type CameraView } from './camera_view';
import fragmentShader from './composite.frag?raw';
import vertexShader from './composite.vert?raw';

const uniforms = () => ({
  picture: { value: new Texture() }, depths: { value: new Texture() }, nearest: { value: 0 }, metresPerUnit: { value: 1 },
  pictureFromRay: { value: new Matrix3() }, shown: { value: false },
});

export class Composite extends Mesh<BufferGeometry, ShaderMaterial> {
  private readonly values = uniforms();

  constructor() {
    super(new BufferGeometry(), new ShaderMaterial({ vertexShader, fragmentShader: captureDepth + colour + fragmentShader }));
    this.geometry.setAttribute('position', new BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
    Object.assign(this.material, { uniforms: this.values, toneMapped: false, fog: false, allowOverride: false, name: 'AcentricWalk' });
    this.renderOrder = -Infinity;
    this.frustumCulled = false;
  }

  /** Of the object, for those who ask how large it is. */
  bounds(bounds: Bundle['bounds']): void {
    const box = new Box3();
    if (bounds) box.setFromPoints([bounds.min, bounds.max].map((corner) => new Vector3(...objectFromWalk(corner))));
    this.geometry.boundingBox = box;
    this.geometry.boundingSphere = box.getBoundingSphere(new Sphere());
  }

  /** It is no body in the scene. */
  override raycast(): void {}

  show({ colour, depth, nearest }: Picture, { pictureFromRay, metresPerUnit }: CameraView, renderer: WebGLRenderer): void {
    const { values } = this;
    for (const [texture, made] of [[values.picture.value, colour], [values.depths.value, depth]] as const)
      (renderer.properties.get(texture) as { __webglTexture: WebGLTexture }).__webglTexture = made;
    values.nearest.value = nearest;
    values.metresPerUnit.value = metresPerUnit;
    values.pictureFromRay.value.set(...(pictureFromRay as Parameters<Matrix3['set']>));
    this.shown = true;
  }
  set shown(shown: boolean) {
    this.values.shown.value = shown;
    this.material.uniformsNeedUpdate = true;
  }

  release(): void {
    this.geometry.dispose();
    this.material.dispose();
  }
}
