#include <cmath>
#include <random>

#include "engine/view/view_plan.h"
#include "gl_fixture.h"
#include "tests/view/mirror_scene.h"

namespace acentric {
namespace {

using test::differingShare;
using test::differingSources;
using test::onCpu;

class GlMesh : public test::WithGl {
 protected:
  std::mt19937 random_{11};
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  PerspectiveView nextView(const Layout& layout, int region, double fovDegrees) {
    PerspectiveView view;
    view.eye = glm::dvec3(test::randomPointIn(layout.regions[std::size_t(region)].polygon, random_),
                          layout.eyeZ() + between(-0.15, 0.15));
    view.yawRadians = between(0, kTwoPi);
    view.pitchRadians = between(-0.3, 0.3);
    view.fovRadians = radians(fovDegrees);
    view.width = 321;
    view.height = 199;
    return view;
  }
};

ViewSettings asMesh() {
  ViewSettings settings;
  settings.renderer = Renderer::glMesh;
  settings.reconstruction = Reconstruction::surface;
  settings.fillHoles = false;
  return settings;
}

TEST_F(GlMesh, Print) {
  for (Configuration configuration : {Configuration::b, Configuration::e})
    for (double density : {2.5, 6.0})
      for (bool secondary : {false, true}) {
        const auto layout = test::layoutAroundOrigin(configuration);
        const int region = *layout->regionAt({0.1, 0.05});
        const WalkScene scene = test::walkScene(test::randomBoxes(3, 60, 3.4), layout, region, density, 3);
        for (int i = 0; i < 3; ++i) {
          ViewSettings settings = asMesh();
          settings.secondaryCover = secondary;
          const PerspectiveView view = nextView(*layout, region, 60);
          const Frame cpu = onCpu(scene, view, settings), gl = onGl(scene, view, settings);
          ViewSettings points = settings;
          points.renderer = Renderer::glZbuffer;
          const Frame z = onGl(scene, view, points);
          std::printf("density %g second %d: differs %.4f sources %.4f holes cpu %zu glz %zu mesh %zu triangles %zu of %zu, build %.1f ms\n",
                      density, secondary, differingShare(cpu.colour, gl.colour), differingSources(cpu, gl),
                      cpu.holeCount(), z.holeCount(), gl.holeCount(), std::size_t(gl.stats.meshTriangles),
                      std::size_t(gl.stats.meshes[0].triangles), 1e3 * gl.stats.meshes[0].buildSeconds);
        }
      }
}

}  // namespace
}  // namespace acentric
