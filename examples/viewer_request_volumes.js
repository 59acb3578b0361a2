// 3D Tiles in three.js by 3d-tiles-renderer, which does not know viewerRequestVolume (0.5.3): this plugin makes it
// show a tile only while a camera stands in the tile's volume. Boxes alone, which is what Acentric writes.
//
//   tiles.registerPlugin(new ViewerRequestVolumes());
import { Vector3 } from 'three';

const eye = new Vector3(), centre = new Vector3(), half = new Vector3();

export class ViewerRequestVolumes {
  name = 'VIEWER_REQUEST_VOLUMES';

  init(tiles) {
    this.tiles = tiles;
  }

  /** True, with target.inView false: whatever the camera sees, it is not shown. */
  calculateTileViewError(tile, target) {
    const box = tile.viewerRequestVolume?.box;
    if (!box || this.tiles.cameras.some((camera) => this.holds(box, tile, camera))) return false;
    target.inView = false;
    return true;
  }

  holds(box, tile, camera) {
    eye.setFromMatrixPosition(camera.matrixWorld).applyMatrix4(this.tiles.group.matrixWorldInverse).applyMatrix4(tile.engineData.transformInverse);
    eye.sub(centre.fromArray(box));
    return [3, 6, 9].every((axis) => Math.abs(eye.dot(half.fromArray(box, axis))) <= half.lengthSq());
  }
}
