#include "engine/layout/paper_culling.h"

#include "engine/base/contract.h"
#include "engine/layout/azimuth_order.h"

namespace acentric {
namespace {

/// The view's borders r_eye and l_eye.
struct Borders {
  glm::dvec2 right, left;
};

Borders bordersOf(const ViewSector& view) {
  return {directionOf(view.azimuths.low), directionOf(view.azimuths.low + view.azimuths.width)};
}

bool sameWay(const glm::dvec2& a, const glm::dvec2& b) { return turn(a, b) == 0 && glm::dot(a, b) > 0; }

/// The middle of a sector of less than half a turn.
glm::dvec2 viewingDirection(const Piece& piece) {
  return glm::normalize(glm::normalize(piece.low.direction()) + glm::normalize(piece.high.direction()));
}

}  // namespace

std::vector<int> cullRingAsInPaper(const Cover& ring, const ViewSector& view) {
  const Borders eye = bordersOf(view);
  const int count = static_cast<int>(ring.pieces.size());
  const bool counterClockwise = ring.hand == Hand::counterClockwise;
  const auto at = [&](int m) -> const Piece& {
    return ring.pieces[std::size_t(((m % count) + count) % count)];
  };
  // A: the camera that holds the direction of the view's right border (left border, in a clockwise ring).
  int first = -1;
  for (int m = 0; m < count && first < 0; ++m) {
    const glm::dvec2 r = at(m).low.direction(), l = at(m).high.direction();
    const bool holds = counterClockwise
                           ? (turn(eye.right, r) < 0 || sameWay(eye.right, r)) && turn(eye.right, l) > 0
                           : turn(eye.left, r) < 0 && (turn(eye.left, l) > 0 || sameWay(eye.left, l));
    if (holds) first = m;
  }
  std::vector<int> cameras;
  if (first < 0) return cameras;
  // On round the ring to the first two neighbours (E, F) whose COPs lie on either side of the view's other
  // border.
  const int step = counterClockwise ? 1 : -1;
  const auto seen = [&](int m) {
    const glm::dvec2 toApex = at(m).apex - view.eye;
    return counterClockwise ? turn(eye.left, toApex) < 0 : turn(eye.right, toApex) > 0;
  };
  for (int m = first; cameras.size() < ring.pieces.size(); m += step) {
    cameras.push_back(at(m).camera);
    if (seen(m) && !seen(m + step)) break;
  }
  return cameras;
}

std::vector<int> cullTriangleAsInPaper(const Cover& gap, const ViewSector& view) {
  require(gap.pieces.size() == 6 && gap.wedges == 3, "Fig. 10 is about the gap triangle");
  const Borders eye = bordersOf(view);
  const auto exterior = [&](int k) -> const Piece& { return gap.pieces[std::size_t(k % 3)]; };
  const auto interior = [&](int k) -> const Piece& { return gap.pieces[std::size_t(3 + (k + 1) % 3)]; };

  const glm::dvec2 looking = directionOf(view.azimuths.low + 0.5 * view.azimuths.width);
  int chosen = 0;
  for (int k = 1; k < 3; ++k)
    if (glm::dot(looking, viewingDirection(interior(k))) >
        glm::dot(looking, viewingDirection(interior(chosen))))
      chosen = k;
  // The paper's letters: A, F to the right of E; C, D to its left.
  const Piece &cameraE = interior(chosen), &cameraA = exterior(chosen + 1), &cameraF = interior(chosen + 2);
  const Piece &cameraC = exterior(chosen + 2), &cameraD = interior(chosen + 1);

  const int right = turn(eye.right, cameraE.low.direction()), left = turn(eye.left, cameraE.high.direction());
  const auto withinView = [&](const Piece& camera) {
    const glm::dvec2 toApex = camera.apex - view.eye;
    return turn(eye.right, toApex) > 0 && turn(eye.left, toApex) < 0;
  };
  if (right <= 0 && left >= 0) return {cameraE.camera};
  if (right > 0 && left > 0)
    return withinView(cameraA) ? std::vector{cameraA.camera, cameraE.camera, cameraF.camera}
                               : std::vector{cameraA.camera, cameraE.camera};
  return withinView(cameraC) ? std::vector{cameraC.camera, cameraD.camera, cameraE.camera}
                             : std::vector{cameraC.camera, cameraE.camera};
}

}  // namespace acentric
