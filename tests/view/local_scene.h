#pragma once
/// A scene of a few triangles and its local geometry, for tests of the rasteriser.

#include <glm/glm.hpp>

#include "engine/view/kernels.h"
#include "engine/view/local_raster.h"
#include "engine/view/walk_scene.h"

namespace acentric::test {

class LocalSceneBuilder {
 public:
  int material(const glm::vec4& colour) {
    Material m;
    m.baseColour = colour;
    scene_.materials.push_back(m);
    return static_cast<int>(scene_.materials.size()) - 1;
  }
  Material& at(int material) { return scene_.materials[static_cast<std::size_t>(material)]; }

  /// a, b, c, d counter-clockwise as seen from the front; uv (0,0), (1,0), (1,1), (0,1).
  void quad(int material, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
    Mesh mesh;
    mesh.material = material;
    mesh.positions = {a, b, c, d};
    mesh.normals.assign(4, glm::normalize(glm::cross(b - a, c - a)));
    mesh.uv[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene_.meshes.push_back(mesh);
  }

  Scene& scene() { return scene_; }

  /// Clipped to a square of the given half width around the origin; one region, nothing baked.
  WalkScene build(double half = 50) {
    WalkScene walk;
    for (Mesh& mesh : scene_.meshes)
      for (const glm::vec3& p : mesh.positions) scene_.bounds.add(p);
    walk.scene = std::make_shared<const Scene>(scene_);
    walk.plan = planEffects(*walk.scene);
    walk.local.push_back(std::make_shared<const LocalGeometry>(clipToPolygon(
        *walk.scene, ConvexPolygon{{{-half, -half}, {half, -half}, {half, half}, {-half, half}}})));
    return walk;
  }

 private:
  Scene scene_;
};

struct LocalPicture {
  Frame frame;
  FloatImage inverseZDepth;
};

/// Local geometry alone over a background of one colour (alpha 0: over holes).
inline LocalPicture drawLocal(const WalkScene& walk, const PerspectiveView& view, int workers = 0,
                              const Rgba8& background = Rgba8(0)) {
  LocalPicture picture;
  picture.frame.colour = ColourImage(view.width, view.height, background);
  picture.frame.source =
      Image<PixelSource>(view.width, view.height, background.a == 0 ? kSourceHole : PixelSource(1));
  picture.inverseZDepth = FloatImage(view.width, view.height, 0.0f);
  TaskRunner runner(workers);
  const LocalShading shading(walk, *walk.local[0]);
  const LocalRaster raster(*walk.local[0], shading, view, runner);
  const Kernels& kernels = supportedKernels().back();
  CoverImage cover;
  raster.findOpaque(kernels.coverRow, cover, runner);
  raster.drawOpaque(cover, kernels.shadeRun, picture.frame, picture.inverseZDepth, runner);
  raster.drawClear(kernels.blendRow, picture.frame, picture.inverseZDepth, runner);
  return picture;
}

}  // namespace acentric::test
