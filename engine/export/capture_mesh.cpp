#include "engine/export/capture_mesh.h"

#include <algorithm>
#include <cmath>

#include "engine/export/slant.h"
#include "engine/geometry/conventions.h"

namespace acentric {
namespace {

/// The sides of a patch along rows are straight, rows are not: they part by less than this in between,
/// samples.
constexpr double kSagitta = 0.1;
/// Widest angle of a patch, radians.
constexpr double kWidestPatch = 0.16;
/// Columns that are meshed together.
constexpr int kBandColumns = 128;
/// A sample that a growing patch foretells within this many bounds may be taken in; fitted again, the patch
/// must then keep to one.
constexpr double kCandidate = 2;
/// Fringes close no wider gaps, samples.
constexpr double kWidestGap = 1;
/// Within so many bounds the sample beside a patch continues its surface.
constexpr double kContinues = 2;

std::vector<Slant> slantsOf(const DisplayCapture& capture) {
  std::vector<std::uint16_t> rows;
  std::vector<float> inverseDistances;
  for (const PackedSample& sample : capture.samples) {
    rows.push_back(std::uint16_t(sample.row));
    inverseDistances.push_back(inverseDistanceOf(sample));
  }
  return acentric::slantsOf(capture.camera, capture.columnStart, rows, inverseDistances);
}

int mostSamples(double pitch, double angle) { return std::clamp(int(angle / pitch), 1, kMostPatchSide); }
/// A side of n columns at tangent t rises by t (n pitch)^2 / 8 in between, at most half of that as an angle.
int mostColumns(const ColumnCamera& camera) {
  const double pitch = camera.columnPitch();
  return mostSamples(pitch, std::min(kWidestPatch, std::sqrt(16 * kSagitta * pitch)));
}

struct Rect {
  int column = 0, row = 0, columns = 1, rows = 1;
};

/// w = a cos + b sin + c (t - t0 cos) of the angle from the middle of a Rect: all the planes there are.
struct Plane {
  double a = 0, b = 0, c = 0, t0 = 0;
  double at(double cos, double sin, double t) const { return a * cos + b * sin + c * (t - t0 * cos); }
};

class BandMesher {
 public:
  /// Columns [first, last).
  BandMesher(const DisplayCapture& capture, std::span<const Slant> slants, const MeshBound& bound, int first,
             int last);
  CaptureMesh run(const std::stop_token& stop);

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;

  const std::uint32_t* pixel(int column, int row) const {
    return &pixelStart_[std::size_t(column - lowColumn_) * std::size_t(rows_ + 1) + std::size_t(row)];
  }
  bool opaque(std::uint32_t sample) const { return capture_.colour[sample].a == 255; }
  bool taken(std::uint32_t sample) const { return taken_[sample - firstSample_] != 0; }
  float inverseOf(std::uint32_t sample) const { return inverseDistanceOf(capture_.samples[sample]); }
  /// Cosine and sine of so many half columns.
  double cosine(int halves) const { return cosine_[std::size_t(std::abs(halves))]; }
  double sine(int halves) const {
    return halves < 0 ? -sine_[std::size_t(-halves)] : sine_[std::size_t(halves)];
  }
  double foretell(int column, int row) const {
    const int halves = 2 * (column - rect_.column) - (rect_.columns - 1);
    return plane_.at(cosine(halves), sine(halves), double(capture_.rowTangent[std::size_t(row)]));
  }
  std::uint32_t& gridAt(int column, int row) { return grid_[std::size_t(column * kMostPatchSide + row)]; }
  float& inverseAt(int column, int row) { return inverse_[std::size_t(column * kMostPatchSide + row)]; }

  void grow(int column, std::uint32_t seed);
  bool extend(int columns, int rows);
  bool takeIn(int column, int row);
  Plane fit(const Rect& rect);
  bool fits(const Rect& rect, const Plane& plane);
  double gapBeside(int column, int row, int insideColumn, int insideRow) const;
  std::uint8_t fringesOf(int column, int row) const;
  void finish(CaptureMesh& out);

  const DisplayCapture& capture_;
  std::span<const Slant> slants_;  // of its samples
  MeshBound bound_;
  int first_, last_;
  int rows_, mostColumns_, mostRows_;
  int lowColumn_, highColumn_;             // of those looked at: one more on either side
  std::uint32_t firstSample_ = 0;          // of column first_
  std::vector<std::uint32_t> pixelStart_;  // of each pixel of those columns, and one behind the column's last
  std::vector<std::uint8_t> taken_;
  std::vector<double> cosine_, sine_;
  Rect rect_;
  Plane plane_;
  double seedAcross_ = 0, seedDown_ = 0;  // where one column or row tells no slope: per radian, per tangent
  std::vector<std::uint32_t> grid_;       // samples of the growing patch
  std::vector<float> inverse_;            // their inverse distances
};

BandMesher::BandMesher(const DisplayCapture& capture, std::span<const Slant> slants, const MeshBound& bound,
                       int first, int last)
    : capture_(capture),
      slants_(slants),
      bound_(bound),
      first_(first),
      last_(last),
      rows_(capture.camera.rows),
      mostColumns_(mostColumns(capture.camera)),
      mostRows_(mostSamples(capture.camera.rowPitch(), kWidestPatch)),
      lowColumn_(std::max(first - 1, 0)),
      highColumn_(std::min(last + 1, capture.camera.columns)),
      firstSample_(capture.columnStart[std::size_t(first)]),
      taken_(capture.columnStart[std::size_t(last)] - firstSample_, 0),
      grid_(kMostPatchSide * kMostPatchSide),
      inverse_(kMostPatchSide * kMostPatchSide) {
  pixelStart_.reserve(std::size_t(highColumn_ - lowColumn_) * std::size_t(rows_ + 1));
  for (int k = lowColumn_; k < highColumn_; ++k) {
    std::uint32_t sample = capture.columnStart[std::size_t(k)];
    const std::uint32_t end = capture.columnStart[std::size_t(k) + 1];
    for (int r = 0; r <= rows_; ++r) {
      while (sample < end && int(capture.samples[sample].row) < r) ++sample;
      pixelStart_.push_back(sample);
    }
  }
  for (int halves = 0; halves <= 4 * kMostPatchSide; ++halves) {
    cosine_.push_back(std::cos(0.5 * halves * capture.camera.columnPitch()));
    sine_.push_back(std::sin(0.5 * halves * capture.camera.columnPitch()));
  }
}

CaptureMesh BandMesher::run(const std::stop_token& stop) {
  CaptureMesh mesh;
  for (int k = first_; k < last_ && !stop.stop_requested(); ++k)
    for (std::uint32_t i = capture_.columnStart[std::size_t(k)]; i < capture_.columnStart[std::size_t(k) + 1];
         ++i)
      if (opaque(i) && !taken(i)) {
        grow(k, i);
        finish(mesh);
      }
  return mesh;
}

/// From one sample by doubling, in both directions by turns, so that patches stay near to squares; where that
/// is too much, by less.
void BandMesher::grow(int column, std::uint32_t seed) {
  const PackedSample& sample = capture_.samples[seed];
  const Slant& slant = slants_[seed];
  rect_ = {column, int(sample.row), 1, 1};
  gridAt(0, 0) = seed;
  const double w = double(inverseAt(0, 0) = inverseOf(seed));
  const double t = double(capture_.rowTangent[sample.row]);
  seedAcross_ = w * slantTangent(slant.across);
  seedDown_ = -w * slantTangent(slant.down) / (1 + t * t);
  plane_ = {w, seedAcross_, seedDown_, t};
  int columns = 1, rows = 1;  // to add next; 0: no more
  while (columns > 0 || rows > 0) {
    rows = std::min(rows, mostRows_ - rect_.rows);
    if (rows > 0) rows = extend(0, rows) ? 2 * rows : rows / 2;
    columns = std::min(columns, mostColumns_ - rect_.columns);
    if (columns > 0) columns = extend(columns, 0) ? 2 * columns : columns / 2;
  }
}

/// Adds columns or rows if all their samples are there and the plane that is then the best keeps to the
/// bound.
bool BandMesher::extend(int columns, int rows) {
  const Rect larger{rect_.column, rect_.row, rect_.columns + columns, rect_.rows + rows};
  if (larger.column + larger.columns > last_ || larger.row + larger.rows > rows_) return false;
  for (int k = columns > 0 ? rect_.columns : 0; k < larger.columns; ++k)
    for (int r = rows > 0 ? rect_.rows : 0; r < larger.rows; ++r)
      if (!takeIn(k, r)) return false;
  const Plane plane = fit(larger);
  if (!fits(larger, plane)) return false;
  rect_ = larger;
  plane_ = plane;
  return true;
}

/// The sample of this pixel, counted from the patch's first, that is nearest to where the plane foretells
/// one.
bool BandMesher::takeIn(int column, int row) {
  const int k = rect_.column + column, r = rect_.row + row;
  const double foretold = foretell(k, r);
  double best = kCandidate * bound_.inverseDistance;
  std::uint32_t found = kNone;
  for (std::uint32_t i = pixel(k, r)[0]; i < pixel(k, r)[1]; ++i) {
    const double away = std::abs(double(inverseOf(i)) - foretold);
    if (away <= best && opaque(i) && !taken(i)) best = away, found = i;
  }
  if (found == kNone) return false;
  gridAt(column, row) = found;
  inverseAt(column, row) = inverseOf(found);
  return true;
}

/// Least squares. With t0 chosen so, and angles symmetric around the middle, the three unknowns part.
Plane BandMesher::fit(const Rect& rect) {
  double sumT = 0, sumCos = 0, sumCos2 = 0, sumSin2 = 0;
  for (int r = 0; r < rect.rows; ++r) sumT += double(capture_.rowTangent[std::size_t(rect.row + r)]);
  for (int k = 0; k < rect.columns; ++k) {
    const double cos = cosine(2 * k - (rect.columns - 1));
    sumCos += cos, sumCos2 += cos * cos, sumSin2 += 1 - cos * cos;
  }
  Plane plane;
  const double meanT = sumT / rect.rows;
  plane.t0 = meanT * sumCos / sumCos2;
  double a = 0, b = 0, c = 0, spread = 0;
  for (int k = 0; k < rect.columns; ++k) {
    const double cos = cosine(2 * k - (rect.columns - 1)), sin = sine(2 * k - (rect.columns - 1));
    double sum = 0, moment = 0;
    for (int r = 0; r < rect.rows; ++r) {
      const double w = double(inverseAt(k, r));
      const double t = double(capture_.rowTangent[std::size_t(rect.row + r)]) - plane.t0 * cos;
      sum += w, moment += w * t, spread += t * t;
    }
    a += cos * sum, b += sin * sum, c += moment;
  }
  plane.a = a / (rect.rows * sumCos2);
  plane.b = rect.columns > 1 ? b / (rect.rows * sumSin2) : seedAcross_;
  plane.c = rect.rows > 1 ? c / spread : seedDown_;
  return plane;
}

bool BandMesher::fits(const Rect& rect, const Plane& plane) {
  for (int k = 0; k < rect.columns; ++k) {
    const double cos = cosine(2 * k - (rect.columns - 1)), sin = sine(2 * k - (rect.columns - 1));
    for (int r = 0; r < rect.rows; ++r) {
      const double w = plane.at(cos, sin, double(capture_.rowTangent[std::size_t(rect.row + r)]));
      if (!(std::abs(w - double(inverseAt(k, r))) <= bound_.inverseDistance)) return false;
    }
  }
  return true;
}

/// How far the patch and the sample of this pixel that continues its surface come apart where they meet, in
/// samples; less than zero if none continues it. The pixel lies beside the patch's own `inside`.
double BandMesher::gapBeside(int column, int row, int insideColumn, int insideRow) const {
  const double allowed = kContinues * bound_.inverseDistance;
  const double foretold = foretell(column, row), inside = foretell(insideColumn, insideRow);
  const double columnPitch = capture_.camera.columnPitch(), rowPitch = capture_.camera.rowPitch();
  double gap = -1;
  for (std::uint32_t i = pixel(column, row)[0]; i < pixel(column, row)[1]; ++i) {
    if (!opaque(i)) continue;
    const double w = double(inverseOf(i));
    const Slant& slant = slants_[i];
    // From the sample to the patch, as its own slant foretells it.
    const double back = w * (slantTangent(slant.across) * columnPitch * (insideColumn - column) +
                             slantTangent(slant.down) * rowPitch * (insideRow - row));
    if (std::abs(w - foretold) > allowed && std::abs(w + back - inside) > allowed) continue;
    const double apart = std::abs(w + 0.5 * back - 0.5 * (foretold + inside));
    gap = std::max(gap, std::min(apart / bound_.inverseDistance, 1.0) * bound_.error);
  }
  return gap;
}

std::uint8_t BandMesher::fringesOf(int column, int row) const {
  const int high = rect_.column + rect_.columns - 1, bottom = rect_.row + rect_.rows - 1;
  const double bend = rect_.columns / double(mostColumns_);
  unsigned bits = 0;
  const auto reach = [&](MeshSide side, int beside, int below, double sagitta) {
    const double gap = gapBeside(column + beside, row + below, column, row);
    if (gap < 0) return;
    const double steps = std::ceil((gap + sagitta) / bound_.fringeStep);
    bits |= unsigned(std::min(steps, double(kMostFringe))) << side;
  };
  if (column == rect_.column && column > 0) reach(kLowColumn, -1, 0, 0);
  if (column == high && column + 1 < capture_.camera.columns) reach(kHighColumn, 1, 0, 0);
  if (row == rect_.row && row > 0) reach(kTopRow, 0, -1, kSagitta * bend * bend);
  if (row == bottom && row + 1 < rows_) reach(kBottomRow, 0, 1, kSagitta * bend * bend);
  return std::uint8_t(bits);
}

void BandMesher::finish(CaptureMesh& out) {
  MeshPatch patch;
  patch.column = std::uint16_t(rect_.column), patch.row = std::uint16_t(rect_.row);
  patch.columns = std::uint8_t(rect_.columns), patch.rows = std::uint8_t(rect_.rows);
  patch.firstSample = std::uint32_t(out.samples.size());
  for (int k = 0; k < rect_.columns; ++k)
    for (int r = 0; r < rect_.rows; ++r) {
      const std::uint32_t sample = gridAt(k, r);
      taken_[sample - firstSample_] = 1;
      patch.roles |= rolesOf(capture_.samples[sample]);
      out.samples.push_back(sample);
      const std::uint8_t fringes = fringesOf(rect_.column + k, rect_.row + r);
      out.fringes.push_back(fringes);
      for (const MeshSide side : kMeshSides)
        patch.fringes =
            std::uint8_t(std::max(patch.fringes & kMostFringe << side, fringes & kMostFringe << side) |
                         (patch.fringes & ~(kMostFringe << side)));
    }
  const glm::dvec2 middle = capture_.camera.directionAt(rect_.column + 0.5 * rect_.columns);
  const std::array<glm::dvec3, 4> corners = cornersOf(capture_.camera, patch, bound_);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec2 direction(corners[i]);
    patch.inverseDistance[i] =
        float(plane_.at(glm::dot(middle, direction), cross(middle, direction), corners[i].z));
  }
  out.patches.push_back(patch);
}

}  // namespace

MeshBound meshBound(const ColumnCamera& camera, double error, double reach) {
  const double pitch = std::min(camera.columnPitch(), camera.rowPitch());
  return {error * pitch / reach, error, (kSagitta + std::min(error, kWidestGap)) / kMostFringe};
}

double eyeReach(const Layout& layout, int camera) {
  const LayoutCamera& from = layout.cameras[std::size_t(camera)];
  double reach = from.roles.empty() ? panoramaReach(layout.spec) : 0;
  for (const Role& role : from.roles)
    for (const glm::dvec2& corner : role.polygon.corners)
      reach = std::max(reach, glm::distance(corner, from.position));
  return reach;
}

std::array<glm::dvec3, 4> cornersOf(const ColumnCamera& camera, const MeshPatch& patch,
                                    const MeshBound& bound) {
  const auto beyond = [&](MeshSide side) { return fringeOf(patch.fringes, side, bound); };
  const auto direction = [&](int border, double past) {
    const glm::dvec2 c = camera.directionAt(border);
    return c + past * camera.columnPitch() * glm::dvec2(-c.y, c.x);
  };
  const auto tangent = [&](int border, double past) {
    const double t = camera.tangentAt(border);
    return t - past * camera.rowPitch() * (1 + t * t);
  };
  const glm::dvec2 low = direction(patch.column, -beyond(kLowColumn)),
                   high = direction(patch.column + patch.columns, beyond(kHighColumn));
  const double top = tangent(patch.row, -beyond(kTopRow)),
               bottom = tangent(patch.row + patch.rows, beyond(kBottomRow));
  return {glm::dvec3(low, top), glm::dvec3(high, top), glm::dvec3(low, bottom), glm::dvec3(high, bottom)};
}

CaptureMesh buildCaptureMesh(const DisplayCapture& capture, const MeshBound& bound, TaskRunner& runner,
                             const std::stop_token& stop) {
  const int columns = capture.camera.columns;
  const std::vector<Slant> slants = slantsOf(capture);
  std::vector<CaptureMesh> bands(std::size_t((columns + kBandColumns - 1) / kBandColumns));
  runner.parallelFor(bands.size(), [&](std::size_t band) {
    if (stop.stop_requested()) return;
    const int first = int(band) * kBandColumns;
    bands[band] =
        BandMesher(capture, slants, bound, first, std::min(first + kBandColumns, columns)).run(stop);
  });
  CaptureMesh mesh;
  for (CaptureMesh& band : bands) {
    const std::uint32_t before = std::uint32_t(mesh.samples.size());
    for (MeshPatch& patch : band.patches) patch.firstSample += before;
    mesh.patches.insert(mesh.patches.end(), band.patches.begin(), band.patches.end());
    mesh.samples.insert(mesh.samples.end(), band.samples.begin(), band.samples.end());
    mesh.fringes.insert(mesh.fringes.end(), band.fringes.begin(), band.fringes.end());
    band = {};
  }
  return mesh;
}

}  // namespace acentric
