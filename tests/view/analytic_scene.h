#pragma once
/// Scenes whose rays are solved by hand, and captures of them: truth for the renderers, without a ray tracer.

#include <functional>
#include <glm/glm.hpp>
#include <random>
#include <vector>

#include "engine/image/capture.h"
#include "engine/view/view_settings.h"
#include "engine/view/walk_scene.h"

namespace acentric::test {

struct AnalyticBox {
  glm::dvec3 min{0}, max{0};
  glm::vec4 colour{1};  ///< linear, straight alpha
};

/// Points whose coordinate `axis` is `at`; infinite: the sky.
struct AnalyticPlane {
  int axis = 2;
  double at = 0;
};

/// Axis-aligned boxes over an optional floor at z = 0, under a sky of one colour.
struct AnalyticScene {
  std::vector<AnalyticBox> boxes;
  bool floor = true;
  glm::vec4 floorColour{0.2f, 0.25f, 0.2f, 1};
  glm::vec4 skyColour{0.3f, 0.5f, 0.7f, 1};
  bool silhouettes = false;  ///< captures know the planes of their samples, which cover pixels whole
  Sky sky() const { return {glm::vec3(skyColour), glm::vec3(skyColour), glm::vec3(skyColour)}; }

  struct Crossing {
    double distance = 0;  ///< in units of `direction`
    glm::vec4 colour{0};
    AnalyticPlane plane;
  };
  /// Every surface along a ray beyond `from`, nearest first (a box counts where the ray enters it).
  std::vector<Crossing> along(const glm::dvec3& origin, const glm::dvec3& direction, double from) const;
};

/// `count` opaque boxes on the floor around the origin, none nearer to it than `innerRadius`.
AnalyticScene randomBoxes(unsigned seed, int count, double innerRadius);
/// The same, drawn as patches.
AnalyticScene randomPatches(unsigned seed, int count, double innerRadius);

/// The ray of a pixel, from where it leaves the region.
struct PixelRay {
  int row = 0;
  glm::dvec3 origin{0}, direction{0};
  double from = 0;  ///< in units of `direction`
};
/// A capture made pixel by pixel, column after column, of what lies beyond `grown` (nullptr: of everything).
Capture captureBy(const ColumnCamera& camera, const ConvexPolygon* grown, const Sky& sky,
                  const std::function<void(Capture&, BackgroundBuilder&, const PixelRay&)>& addPixel);
/// That the last sample lies on, as seen from `centre`.
void addPlane(CaptureSamples& list, const glm::dvec3& centre, const AnalyticPlane& plane);
/// Needed by every role.
void addSample(CaptureSamples& list, int row, double distance, const glm::vec4& colour);

/// Up to `layers` surfaces per pixel, of what lies beyond `region` grown by the near band (nullptr: of
/// everything).
Capture capture(const AnalyticScene& scene, const ColumnCamera& camera, const ConvexPolygon* grown,
                int layers = 1);

/// A column camera of a layout camera, `perDegree` columns and rows per degree, elevations +-60 degrees.
ColumnCamera columnCamera(const Layout& layout, int camera, double perDegree);

/// A layout around the origin with the ring (or any region) that holds the origin in its middle.
std::shared_ptr<const Layout> layoutAroundOrigin(Configuration configuration, double cellSize = 2,
                                                 double nearBand = 0.5);

/// Captures of all the cameras of one region's covers, each made by `captureOf`.
WalkScene walkWith(std::shared_ptr<const Layout> layout, int region, double perDegree,
                   const std::function<Capture(const ColumnCamera&, const ConvexPolygon& grown)>& captureOf);
WalkScene walkScene(const AnalyticScene& scene, std::shared_ptr<const Layout> layout, int region,
                    double perDegree, int layers = 1);

glm::dvec2 randomPointIn(const ConvexPolygon& polygon, std::mt19937& random);

/// Share of pixels whose colours differ by more than `tolerance` codes in some channel.
double differingShare(const ColourImage& a, const ColourImage& b, int tolerance = 0);

}  // namespace acentric::test
