/** Work of our own in the WebGL2 context of a renderer of three.js, before, within and after its frames. */

import { Color, Vector4, type WebGLRenderer } from 'three';

const viewport = new Vector4(), clearColour = new Color();

/** From and to the state that three.js knows of, with the target that it draws into. */
export function sharingState<Result>(renderer: WebGLRenderer, work: () => Result): Result {
  const gl = renderer.getContext() as WebGL2RenderingContext;
  const target = renderer.getRenderTarget(), face = renderer.getActiveCubeFace(), level = renderer.getActiveMipmapLevel();
  const reversed = renderer.state.buffers.depth.getReversed?.() === true;
  renderer.getCurrentViewport(viewport);
  renderer.resetState();
  for (const flag of [gl.UNPACK_FLIP_Y_WEBGL, gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL]) gl.pixelStorei(flag, false); // older versions leave them
  for (const number of [gl.UNPACK_ROW_LENGTH, gl.UNPACK_IMAGE_HEIGHT, gl.UNPACK_SKIP_PIXELS, gl.UNPACK_SKIP_ROWS, gl.UNPACK_SKIP_IMAGES])
    gl.pixelStorei(number, 0);
  try {
    return work();
  } finally {
    renderer.resetState();
    if (reversed) { // which a reset undoes, with what depth is cleared to
      renderer.state.buffers.depth.setReversed(true);
      renderer.state.buffers.depth.setClear(1);
    }
    renderer.setRenderTarget(target, face, level);
    renderer.state.viewport(viewport); // may be a part of the target
    renderer.setClearColor(renderer.getClearColor(clearColour), renderer.getClearAlpha());
  }
}
