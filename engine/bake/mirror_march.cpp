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
  met.hit.distance = float(distance);
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
    if (!(sky ? role.holdsBackground : role.holds(place))) continue;
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

std::uint8_t MirrorMarch::giveTo(std::vector<RoleOnRay*>& roles, double distance, bool isClear) const {
  if (isClear)
    keepLastPlace(roles, maxLayers_);
  else
    for (RoleOnRay* role : roles) role->opaqueAt = distance;
  return give(roles);
}

/// What the camera sees in the mirror itself is kept for those who see the mirror there; others may see it
/// elsewhere in the mirror. Returns the distance of the farthest, 0 if there is none.
double MirrorMarch::addSeenByCamera(const Pixel& pixel, const FlatMirror& mirror,
                                    std::vector<ShownInMirror>& shown, RayCounts& rays) {
  double farthest = 0;
  const std::size_t known = shown.size();
  for (std::size_t i = 0; i < known; ++i) {
    if (shown[i].mirror != mirror.number) continue;
    const Met met = metAt(pixel, mirror, shown[i].surface, shown[i].distance);
    ask(pixel, mirror, met, true, rays);
    shown[i].roles = giveTo(sides_.met, met.distance, shown[i].isClear());
    addSide(pixel, mirror, met, Side::other, shown, rays);
    farthest = std::max(farthest, met.distance);
  }
  std::erase_if(shown, [](const ShownInMirror& s) { return s.roles == 0; });
  return farthest;
}

/// Without what is before it, which is clear and has samples of its own.
void MirrorMarch::addSide(const Pixel& pixel, const FlatMirror& mirror, const Met& met, Side side,
                          std::vector<ShownInMirror>& shown, RayCounts& rays) {
  std::vector<RoleOnRay*>& roles = sides_.of(side);
  if (roles.empty()) return;
  const MirrorSight::Seen& by = side == Side::met ? byMet_ : byOther_;
  const glm::vec3 direction(mirror.reflected(pixel.direction));
  Shaded seen;
  if (met.surface)
    seen = shader_.shade(met.hit, met.surface->toViewer(side), rays, true,
                         pixel.footprint.mirrored(glm::vec3(mirror.normal), 0)
                             .on(shader_.scene().scene(), met.hit, direction));
  else
    seen.emission = shader_.background(direction);
  if (seen.alpha < kInvisibleAlpha) return;
  const bool clear = seen.alpha < kOpaqueAlpha;
  const Shaded surface = shader_.flatMirrorUnder(seen.radiance(), by.mirror, by.toEye);
  if (const std::uint8_t mask = giveTo(roles, met.distance, clear); mask != 0)
    shown.push_back({met.distance, packColour({surface.radiance(), clear ? seen.alpha : 1}), mask,
                     mirror.number, side, met.hit});
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
    const Hit hit = scene.trace(ray);
    if (hit.found() && double(hit.distance) > span.to) return;
    const Met met = metAt(pixel, mirror, hit, double(hit.distance));
    ask(pixel, mirror, met, false, rays);
    for (const Side side : {Side::met, Side::other}) addSide(pixel, mirror, met, side, shown, rays);
    if (!hit.found()) return;
    ray.nearest = justBehind(hit.distance);
  }
}

}  // namespace acentric
