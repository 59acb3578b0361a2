#include "engine/bake/mirror_march.h"

#include <algorithm>

namespace acentric {

MirrorMarch::MirrorMarch(const Shader& shader, const MirrorSight& sight, int maxLayers, double sameDepth,
                         double rightBehind)
    : shader_(shader),
      sight_(sight),
      maxLayers_(maxLayers),
      sameDepth_(sameDepth),
      rightBehind_(rightBehind),
      hints_(sight.hints()) {}

void MirrorMarch::run(const Pixel& pixel, std::vector<ShownInMirror>& shown, RayCounts& rays,
                      const std::stop_token& stop) {
  sight_.spansAlong(pixel.origin, pixel.direction, spans_);
  for (const MirrorSight::Span& span : spans_) follow(pixel, span, shown, rays, stop);
}

/// The roles that may have what lies at a distance along the ray: one that sees it is enough for all, since
/// it is stored then anyway, and eyes between the test eyes may see it. They are taken to have it from then
/// on.
std::uint8_t MirrorMarch::wantedBy(const Pixel& pixel, const FlatMirror& mirror, double distance, bool isSeen,
                                   RayCounts& rays) {
  const bool sky = !(distance < std::numeric_limits<double>::infinity());
  const glm::dvec3 place = pixel.origin + (sky ? 0 : distance) * pixel.direction;
  candidates_.clear();
  for (Wanting& wanting : wanting_) {
    const ColumnRole& role = *wanting.role;
    if (role.exit > distance * pixel.flat * (1 + kBorderSlack)) break;
    if (isFull(wanting) || !(distance * (1 - rightBehind_) > wanting.opaqueAt)) continue;
    if (sky ? role.holdsBackground : role.clip == nullptr || role.clip->holds(glm::dvec2(place)))
      candidates_.push_back(&wanting);
  }
  for (const Wanting* wanting : candidates_) {
    if (isSeen) break;
    const std::size_t role = wanting->role->index;
    const auto seen = sky ? sight_.seesAlong(role, mirror, pixel.direction, hints_, rays)
                          : sight_.sees(role, mirror, place, sameDepth_ * distance, hints_, rays);
    isSeen = seen.has_value();
    if (seen) seen_ = *seen;
  }
  if (!isSeen) return 0;
  std::uint8_t mask = 0;
  for (Wanting* wanting : candidates_) {
    mask |= wanting->role->bit;
    ++wanting->stored;
    wanting->opaqueAt = distance;
  }
  return mask;
}

/// What the camera sees in the mirror itself is kept for those who see the mirror there; others may see it
/// elsewhere in the mirror. Returns its distance, 0 if there is none.
double MirrorMarch::addSeenByCamera(const Pixel& pixel, const FlatMirror& mirror,
                                    std::vector<ShownInMirror>& shown, RayCounts& rays) {
  double farthest = 0;
  for (ShownInMirror& s : shown) {
    if (s.mirror != mirror.number) continue;
    s.roles |= wantedBy(pixel, mirror, s.distance, true, rays);
    farthest = std::max(farthest, s.distance);
  }
  return farthest;
}

void MirrorMarch::follow(const Pixel& pixel, const MirrorSight::Span& span, std::vector<ShownInMirror>& shown,
                         RayCounts& rays, const std::stop_token& stop) {
  const FlatMirror& mirror = *span.mirror;
  wanting_.clear();
  for (const ColumnRole& role : pixel.roles) wanting_.push_back({&role});
  const double known = addSeenByCamera(pixel, mirror, shown, rays);
  Ray ray{glm::vec3(mirror.imageOf(pixel.origin)), glm::vec3(mirror.reflected(pixel.direction)),
          std::max(float(span.from), known > 0 ? justBehind(float(known)) : 0)};
  const RayScene& scene = shader_.scene();
  for (int step = 0; step < kMaxMarch && !stop.stop_requested(); ++step) {
    const auto next = std::ranges::find_if(wanting_, [&](const Wanting& w) { return !isFull(w); });
    if (next == wanting_.end()) return;
    ray.nearest = std::max(ray.nearest, float(next->role->exit / pixel.flat));
    if (!(double(ray.nearest) < span.to)) return;
    ++rays.mirror;
    const Hit hit = scene.traceSolid(ray);
    const double distance = double(hit.distance);
    if (hit.found() && distance > span.to) return;
    if (const std::uint8_t mask = wantedBy(pixel, mirror, distance, false, rays); mask != 0) {
      const Shader::Seen seen = shader_.seenAlong(ray, &RayCounts::mirror, rays, true);
      const Shaded surface = shader_.flatMirrorUnder(seen.radiance, seen_.mirror, seen_.toEye);
      shown.push_back({std::min(distance, double(seen.opaqueDistance)), packColour({surface.radiance(), 1}),
                       mask, mirror.number});
    }
    if (!hit.found()) return;
    ray.nearest = justBehind(hit.distance);
  }
}

}  // namespace acentric
