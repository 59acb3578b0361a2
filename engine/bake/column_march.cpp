#include "engine/bake/column_march.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/bake/surface_planes.h"

namespace acentric {
namespace {

/// Of a distance: so near behind an opaque surface the test eyes' maps are not trusted.
constexpr double kSoonBehind = 3 * kSameSurface;

bool looksLike(const Shaded& a, const Shaded& b) {
  const glm::vec3 ofA = a.alpha * a.radiance(), ofB = b.alpha * b.radiance();
  return std::abs(a.alpha - b.alpha) <= kContrast * (1.01f - std::max(a.alpha, b.alpha)) &&
         glm::all(glm::lessThanEqual(glm::abs(ofA - ofB), kContrast * glm::max(ofA, ofB)));
}

}  // namespace

SampleFootprint sampleFootprint(const ColumnMarch::Setting& setting, const glm::vec3& direction) {
  if (setting.textures == nullptr) return {};
  const float flat = glm::length(glm::vec2(direction));
  const glm::vec2 across = float(setting.columns.columnPitch()) * glm::vec2(-direction.y, direction.x);
  const glm::vec3 up(glm::vec2(direction) * (-direction.z / flat), flat);
  return {setting.textures, {glm::vec3(across, 0), float(setting.columns.rowPitch()) * up}};
}

glm::vec3 towardsEyes(const ColumnMarch::Setting& setting, std::uint8_t roles, const MetSurface& surface,
                      Side side) {
  glm::dvec3 sum(0);
  double count = 0;
  for (std::size_t role = 0; role < setting.eyes.size(); ++role)
    if ((roles & roleBit(setting.camera, int(role))) != 0) sum += setting.eyes[role], ++count;
  const glm::dvec3 eye = sum / count;
  return count > 0 && surface.sideOf(eye) == side ? glm::normalize(glm::vec3(eye - surface.point()))
                                                  : surface.toViewer(side);
}

ColumnMarch::ColumnMarch(const Setting& setting, ChunkSamples& out)
    : setting_(setting),
      out_(out),
      sameDepth_(kSameDepth * setting.columns.rowPitch()),
      rightBehind_(std::max(sameDepth_, kSameSurface)) {
  if (setting.sight != nullptr) hints_ = setting.sight->hints();
  if (setting.beyond != nullptr)
    mirrorMarch_.emplace(setting.shader, *setting.beyond, setting.settings.maxLayers, sameDepth_,
                         rightBehind_);
  if (setting.mirrors != nullptr && setting.settings.silhouettes)
    for (const FlatMirror& mirror : setting.mirrors->sides()) mirrors_[mirror.number] = mirror;
}

bool ColumnMarch::run(int column, const std::stop_token& stop) {
  column_ = column;
  direction_ = setting_.columns.directionAt(column + 0.5);
  roles_ = rolesAlong(setting_.camera, direction_);
  having_.clear();
  for (const ColumnRole& role : roles_) having_.push_back({&role});
  alone_ = !setting_.settings.silhouettes && roles_.size() == 1 && roles_.front().clip == nullptr &&
           setting_.sight == nullptr && setting_.mirrors == nullptr && setting_.settings.maxLayers == 1;
  const std::size_t before = out_.row.size(), shownBefore = out_.reflections.row.size();
  for (int row = 0; row < setting_.columns.rows && !roles_.empty(); row += RayPacket::kSize) {
    if (stop.stop_requested()) return false;
    runRows(row, std::min(row + RayPacket::kSize, setting_.columns.rows), stop);
  }
  out_.perColumn.push_back(std::uint32_t(out_.row.size() - before));
  out_.background.closeColumn();
  if (setting_.mirrors != nullptr)
    out_.reflections.perColumn.push_back(std::uint32_t(out_.reflections.row.size() - shownBefore));
  return true;
}

void ColumnMarch::runRows(int first, int last, const std::stop_token& stop) {
  const RayPacket packet =
      firstRays(setting_.columns, setting_.rows, direction_, first, last, roles_.front().begin());
  setting_.shader.scene().trace(packet, hits_);
  out_.counts.rays.primary += std::uint64_t(packet.count);
  for (int row = first; row < last; ++row) {
    const auto n = std::size_t(row - first);
    if (alone_ && addAlone(row, packet.direction[n], hits_[n])) continue;
    beginPixel(row);
    if (const ColumnRole* next = addHit(packet.direction[n], hits_[n]))
      runPixel(packet.direction[n], hits_[n].distance, next, stop);
    addBackgroundAlong(packet.direction[n]);
    if (mirrorMarch_)
      mirrorMarch_->run({setting_.columns.centreOfProjection, glm::dvec3(packet.direction[n]), roles_,
                         sampleFootprint(setting_, packet.direction[n])},
                        shown_, out_.counts.rays, stop);
    if (!shown_.empty()) addShown(packet.direction[n]);
  }
}

Shaded ColumnMarch::shade(const Hit& hit, const glm::vec3& direction, const glm::vec3& toViewer) {
  return setting_.shader.shade(
      hit, toViewer, out_.counts.rays, false,
      sampleFootprint(setting_, direction).on(setting_.shader.scene().scene(), hit, direction));
}

/// A pixel of a column that serves one role, with one layer and without pruning: no march. False where the
/// surface does not hide what is behind it.
bool ColumnMarch::addAlone(int row, const glm::vec3& direction, const Hit& hit) {
  const std::uint8_t mask = roles_.front().bit;
  if (!hit.found()) {
    addBackground(row, mask);
    return true;
  }
  const double horizontal = double(hit.distance) * setting_.rows.cosine[std::size_t(row)];
  if (roles_.front().exit > horizontal * (1 + kBorderSlack)) return false;
  const float stored = storedInverseDistance(1 / horizontal, setting_.distanceStep);
  if (const auto& even = setting_.shader.evenColours(); !even.empty()) {
    out_.add(row, stored, even[hit.mesh], mask);
  } else {
    const Shaded shaded = shade(hit, direction, -direction);
    if (shaded.alpha < kOpaqueAlpha) return false;
    out_.add(row, stored, packColour({shaded.radiance(), 1}), mask);
  }
  ++out_.counts.samples.kept[0];
  return true;
}

void ColumnMarch::beginPixel(int row) {
  row_ = row;
  flat_ = setting_.rows.cosine[std::size_t(row)];
  layer_ = 0;
  reachedBackground_ = false;
  for (RoleOnRay& having : having_) having = {having.role};
}

/// What is behind the pixel's first hit: from surface to surface, until every role has all it may have, or
/// nothing is left that it could see.
void ColumnMarch::runPixel(const glm::vec3& direction, float distance, const ColumnRole* next,
                           const std::stop_token& stop) {
  Ray ray{glm::vec3(setting_.columns.centreOfProjection), direction};
  for (int step = 1; step < kMaxMarch && next != nullptr && !stop.stop_requested(); ++step) {
    ray.nearest = std::max(justBehind(distance), float(next->begin() / flat_));
    ++out_.counts.rays.primary;
    const Hit hit = setting_.shader.scene().trace(ray);
    next = addHit(direction, hit);
    distance = hit.distance;
  }
}

/// The next role that may still have samples behind the hit: ahead of its exit nobody needs anything. None if
/// the pixel is done.
const ColumnRole* ColumnMarch::addHit(const glm::vec3& direction, const Hit& hit) {
  if (!hit.found()) {
    reachedBackground_ = true;
    return nullptr;
  }
  addSurface(direction, hit);
  const auto next = std::ranges::find_if(having_, [&](const RoleOnRay& r) { return !isFull(r); });
  return next == having_.end() ? nullptr : next->role;
}

/// Does the surface, which is met within the role's grown polygon, lie beyond it where a neighbouring ray
/// meets its plane?
bool ColumnMarch::goesOnBeyond(const ColumnRole& role, const Hit& hit, const glm::dvec3& point) const {
  const glm::dvec3 normal(hit.geometricNormal());
  const double height = glm::dot(normal, point - setting_.columns.centreOfProjection);
  const Role& served = setting_.camera.roles[role.index];
  const auto liesBeyond = [&](const glm::dvec2& across, double cosine, double sine, double exit) {
    const double perMetre = glm::dot(normal, glm::dvec3(across * cosine, sine)) / height;
    return !(perMetre * exit > cosine);  // as far as the border, or on without end
  };
  const double sine = setting_.rows.sine[std::size_t(row_)];
  for (const int step : {-1, 1}) {
    const glm::dvec2 beside = setting_.columns.directionAt(column_ + 0.5 + step);
    if (liesBeyond(beside, flat_, sine, exitDistance(setting_.camera, served, beside))) return true;
    const double elevation = setting_.columns.elevationAt(row_ + 0.5 + step);
    if (liesBeyond(direction_, std::cos(elevation), std::sin(elevation), role.exit)) return true;
  }
  return false;
}

void ColumnMarch::addSurface(const glm::vec3& direction, const Hit& hit) {
  const double horizontal = double(hit.distance) * flat_;
  const glm::dvec3 point = setting_.columns.centreOfProjection + double(hit.distance) * glm::dvec3(direction);
  const double tolerance = sameDepth_ * double(hit.distance);
  const MetSurface surface(hit, point, direction);
  const std::uint8_t mirror =
      setting_.mirrors == nullptr ? 0 : setting_.mirrors->at(hit.mesh, hit.triangle, -direction);
  sides_.clear();
  facing_.clear();
  bool limited = false, wanted = false;
  for (RoleOnRay& having : having_) {
    const ColumnRole& role = *having.role;
    if (role.begin() > horizontal) break;
    if (role.exit > horizontal * (1 + kBorderSlack) && !goesOnBeyond(role, hit, point)) continue;
    const bool inPart = role.holds(glm::dvec2(point));
    if (!inPart && mirror == 0) continue;
    wanted = true;
    if (isFull(having)) {
      limited = limited || inPart;
      continue;
    }
    Side side = Side::met;
    if (setting_.sight != nullptr) {
      const bool soonBehind = !(horizontal * (1 - kSoonBehind) > having.opaqueAt);
      side = setting_.sight->sees(role.index, surface, tolerance, hints_, out_.counts.rays, soonBehind);
      const bool rightBehind = !(horizontal * (1 - rightBehind_) > having.opaqueAt);
      if (side == Side::none || (rightBehind && side == having.opaqueSide)) continue;
    }
    if (inPart) sides_.of(side).push_back(&having);
    if (mirror != 0 && side == Side::met) facing_.push_back(&role);
  }
  if (sides_.empty() && wanted) ++(limited ? out_.counts.samples.overLimit : out_.counts.samples.hidden);
  if (setting_.settings.silhouettes && !(sides_.empty() && facing_.empty()))
    plane_ =
        planeOf(setting_.shader.scene().scene(), hit, setting_.columns.centreOfProjection, direction, false);
  if (mirror != 0 && !(sides_.met.empty() && facing_.empty()))
    addSide(sides_.met, Side::met, mirrorSurface(direction, hit, horizontal, mirror), horizontal, mirror);
  else
    addAsSeen(sides_.met, surface, Side::met, direction, hit, horizontal);
  addAsSeen(sides_.other, surface, Side::other, direction, hit, horizontal);
}

/// What looks different to each region gets a sample for each, as the middle of its eyes sees it; those that
/// see about the same share one.
void ColumnMarch::addAsSeen(std::vector<RoleOnRay*>& needed, const MetSurface& surface, Side side,
                            const glm::vec3& direction, const Hit& hit, double horizontal) {
  if (needed.empty()) return;
  const Shaded shaded = shade(hit, direction, surface.toViewer(side));
  if (!shaded.dependsOnViewer) {
    addSide(needed, side, shaded, horizontal, 0);
    return;
  }
  looks_.clear();
  for (RoleOnRay* having : needed) {
    const Shaded own = shade(hit, direction, towardsEyes(setting_, having->role->bit, surface, side));
    const auto same =
        std::ranges::find_if(looks_, [&](const Look& look) { return looksLike(look.shaded, own); });
    if (same != looks_.end())
      same->roles.push_back(having);
    else
      looks_.push_back({own, {having}});
  }
  for (Look& look : looks_) addSide(look.roles, side, look.shaded, horizontal, 0);
}

/// A sample of one side of a surface for the roles that see it.
void ColumnMarch::addSide(std::vector<RoleOnRay*>& needed, Side side, const Shaded& shaded, double horizontal,
                          std::uint8_t mirror) {
  const bool opaque = shaded.alpha >= kOpaqueAlpha;
  if (needed.empty() || shaded.alpha < kInvisibleAlpha) return;
  if (!opaque) keepLastPlace(needed, setting_.settings.maxLayers);
  if (needed.empty()) {
    ++out_.counts.samples.overLimit;
    return;
  }
  if (opaque)
    for (RoleOnRay* having : needed) having->opaqueAt = horizontal, having->opaqueSide = side;
  out_.add(row_, storedInverseDistance(1 / horizontal, setting_.distanceStep),
           packColour({shaded.radiance(), opaque ? 1 : shaded.alpha}), give(needed));
  if (setting_.mirrors != nullptr) out_.mirror.push_back(mirror);
  if (setting_.settings.silhouettes) out_.addPlane({plane_.normal, side == Side::other ? 1u : 0u});
  ++out_.counts.samples.kept[std::min(std::size_t(layer_++), SampleCounts::kLayers - 1)];
}

/// The surface of a plane mirror; what it shows is kept for the roles in facing_ whose part holds its virtual
/// place, which may be another part than the mirror's own.
Shaded ColumnMarch::mirrorSurface(const glm::vec3& direction, const Hit& hit, double horizontal,
                                  std::uint8_t mirror) {
  const Shader::Mirrored mirrored = setting_.shader.shadeFlatMirror(hit, -direction, out_.counts.rays,
                                                                    sampleFootprint(setting_, direction));
  int clear = 0;
  for (const Shader::Layer& layer : mirrored.shown) {
    if (layer.alpha < 1 && ++clear >= setting_.settings.maxLayers) continue;  // keepLastPlace
    const bool sky = !layer.hit.found();
    const double reach = horizontal * (1 + double(layer.hit.distance) / double(hit.distance));
    const glm::dvec2 place = setting_.camera.position + reach * direction_;
    std::uint8_t mask = 0;
    for (const ColumnRole* role : facing_)
      if (sky ? role->holdsBackground : role->holds(place)) mask |= role->bit;
    if (mask != 0)
      shown_.push_back(
          {reach / flat_, packColour({layer.radiance, layer.alpha}), mask, mirror, Side::met, layer.hit});
  }
  return mirrored.surface;
}

/// What the mirrors of the pixel show, nearest first.
void ColumnMarch::addShown(const glm::vec3& direction) {
  std::ranges::stable_sort(shown_, {}, &ShownInMirror::distance);
  for (const ShownInMirror& s : shown_) {
    const float w = s.isSky() ? 0 : storedInverseDistance(1 / (s.distance * flat_), setting_.distanceStep);
    out_.reflections.add(row_, w, s.colour, s.roles);
    out_.reflections.mirror.push_back(s.mirror);
    if (setting_.settings.silhouettes)
      out_.reflections.addPlane(
          s.isSky() ? SurfacePlane{}
                    : imagePlaneOf(setting_.shader.scene().scene(), s.surface, mirrors_[s.mirror],
                                   setting_.columns.centreOfProjection, s.distance * glm::dvec3(direction),
                                   s.side == Side::other));
  }
  out_.counts.reflections += shown_.size();
  shown_.clear();
}

/// For the roles that see it, whatever the march met before, or how many samples they have: behind all
/// surfaces there is the background, and it takes none.
void ColumnMarch::addBackgroundAlong(const glm::vec3& direction) {
  std::uint8_t mask = 0;
  for (const RoleOnRay& having : having_) {
    const ColumnRole& role = *having.role;
    if (role.holdsBackground &&
        (setting_.sight == nullptr
             ? reachedBackground_ && !isFull(having)
             : setting_.sight->seesAlong(role.index, glm::dvec3(direction), hints_, out_.counts.rays)))
      mask |= role.bit;
  }
  if (mask != 0) addBackground(row_, mask);
}

void ColumnMarch::addBackground(int row, std::uint8_t mask) {
  out_.background.add(row, mask);
  ++out_.counts.samples.background;
}

}  // namespace acentric
