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

MirrorMarch::Met MirrorMarch::metAt(const Pixel& pixel, const FlatMirror& mirror, const Hit& hit,
                                    double distance) const {
  Met met{hit, distance, std::nullopt};
  if (hit.found())
    met.surface.emplace(hit, mirror.imageOf(pixel.origin + distance * pixel.direction),
                        glm::vec3(mirror.reflected(pixel.direction)));
  return met;
}

/// Which side do the roles see that may have it? What is known to be seen may yet be seen from behind.
void MirrorMarch::ask(const Pixel& pixel, const FlatMirror& mirror, const Met& met, bool isKnown,
                      RayCounts& rays) {
  const bool sky = !met.surface;
  const glm::dvec2 place(pixel.origin + (sky ? 0 : met.distance) * pixel.direction);
  sides_.clear();
  unseen_.clear();
  for (RoleOnRay& having : roles_) {
    const ColumnRole& role = *having.role;
    if (isFull(having) || !(met.distance * (1 - rightBehind_) > having.opaqueAt)) continue;
    if (!(sky ? role.holdsBackground : role.clip == nullptr || role.clip->holds(place))) continue;
    std::optional<MirrorSight::Seen> seen;
    if (!sky)
      seen = sight_.sees(role.index, mirror, *met.surface, sameDepth_ * met.distance, hints_, rays);
    else if (!isKnown && sides_.empty())
      seen = sight_.seesAlong(role.index, mirror, pixel.direction, hints_, rays);
    if (!seen) {
      unseen_.push_back(&having);
      continue;
    }
    sides_.of(seen->side).push_back(&having);
    (seen->side == Side::met ? byMet_ : byOther_) = *seen;
  }
  // One that sees a side is enough for all that may see it, since it is stored then anyway, and eyes between
  // the test eyes may see it.
  const bool hasMet = isKnown || !sides_.met.empty(), hasOther = !sides_.other.empty();
  const auto mayBeOn = [&](Side side, const RoleOnRay& having) {
    return sky || sight_.isOn(side, having.role->index, mirror, *met.surface);
  };
  for (RoleOnRay* having : unseen_) {
    if (hasMet && mayBeOn(Side::met, *having))
      sides_.met.push_back(having);
    else if (hasOther && mayBeOn(Side::other, *having))
      sides_.other.push_back(having);
  }
}

std::uint8_t MirrorMarch::giveTo(std::span<RoleOnRay* const> roles, double distance) const {
  for (RoleOnRay* role : roles) role->opaqueAt = distance;
  return give(roles);
}

/// What the camera sees in the mirror itself is kept for those who see the mirror there; others may see it
/// elsewhere in the mirror. Returns its distance, 0 if there is none.
double MirrorMarch::addSeenByCamera(const Pixel& pixel, const FlatMirror& mirror,
                                    std::vector<ShownInMirror>& shown, RayCounts& rays) {
  double farthest = 0;
  const std::size_t known = shown.size();
  for (std::size_t i = 0; i < known; ++i) {
    if (shown[i].mirror != mirror.number) continue;
    const Met met = metAt(pixel, mirror, shown[i].surface, shown[i].distance);
    ask(pixel, mirror, met, true, rays);
    shown[i].roles = giveTo(sides_.met, met.distance);
    addOther(mirror, met, shown, rays);
    farthest = std::max(farthest, met.distance);
  }
  std::erase_if(shown, [](const ShownInMirror& s) { return s.roles == 0; });
  return farthest;
}

void MirrorMarch::addMet(const FlatMirror& mirror, const Met& met, const Ray& ray,
                         std::vector<ShownInMirror>& shown, RayCounts& rays) {
  if (sides_.met.empty()) return;
  const Shader::Seen seen = shader_.seenAlong(ray, &RayCounts::mirror, rays, true);
  const Shaded surface = shader_.flatMirrorUnder(seen.radiance, byMet_.mirror, byMet_.toEye);
  shown.push_back({std::min(met.distance, double(seen.opaque.distance)), packColour({surface.radiance(), 1}),
                   giveTo(sides_.met, met.distance), mirror.number, seen.opaque});
}

/// Without the glass before the side that the ray meets: the eyes do not look through that.
void MirrorMarch::addOther(const FlatMirror& mirror, const Met& met, std::vector<ShownInMirror>& shown,
                           RayCounts& rays) {
  if (sides_.other.empty()) return;
  const Shaded seen = shader_.shade(met.hit, met.surface->toViewer(Side::other), rays, true);
  const Shaded surface = shader_.flatMirrorUnder(seen.radiance(), byOther_.mirror, byOther_.toEye);
  shown.push_back({met.distance, packColour({surface.radiance(), 1}), giveTo(sides_.other, met.distance),
                   mirror.number, met.hit});
}

/// From the mirror on, also within the region: nothing else would show its image there, as local geometry
/// does for surfaces themselves.
void MirrorMarch::follow(const Pixel& pixel, const MirrorSight::Span& span, std::vector<ShownInMirror>& shown,
                         RayCounts& rays, const std::stop_token& stop) {
  const FlatMirror& mirror = *span.mirror;
  roles_.clear();
  for (const ColumnRole& role : pixel.roles) roles_.push_back({&role});
  const double known = addSeenByCamera(pixel, mirror, shown, rays);
  Ray ray{glm::vec3(mirror.imageOf(pixel.origin)), glm::vec3(mirror.reflected(pixel.direction)),
          std::max(float(span.from), known > 0 ? justBehind(float(known)) : 0)};
  const RayScene& scene = shader_.scene();
  for (int step = 0; step < kMaxMarch && !stop.stop_requested(); ++step) {
    if (std::ranges::all_of(roles_, [&](const RoleOnRay& r) { return isFull(r); })) return;
    if (!(double(ray.nearest) < span.to)) return;
    ++rays.mirror;
    const Hit hit = scene.traceSolid(ray);
    if (hit.found() && double(hit.distance) > span.to) return;
    const Met met = metAt(pixel, mirror, hit, double(hit.distance));
    ask(pixel, mirror, met, false, rays);
    addMet(mirror, met, ray, shown, rays);
    addOther(mirror, met, shown, rays);
    if (!hit.found()) return;
    ray.nearest = justBehind(hit.distance);
  }
}

}  // namespace acentric
