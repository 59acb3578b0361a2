#include "engine/pipeline/scene_storeys.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/base/contract.h"
#include "engine/pipeline/pipeline.h"
#include "engine/pipeline/scene_probe.h"

namespace acentric {
namespace {

constexpr double kNearHeight = 0.5;  // metres

std::string listOf(const Storeys& storeys) {
  std::string list;
  for (std::size_t s = 0; s < storeys.planes.size(); ++s)
    list += fmt::format("{}{} at {:.2f} m", s == 0 ? "" : ", ", s, storeys.planes[s].height);
  return list;
}

template <class T>
std::optional<T> numberFrom(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

Result<StoreyChoice> parseStoreyChoice(std::string_view text) {
  if (const auto number = numberFrom<int>(text); number && *number >= 0) return StoreyChoice{number, {}};
  if (text.ends_with('m'))
    if (const auto height = numberFrom<double>(text.substr(0, text.size() - 1));
        height && std::isfinite(*height))
      return StoreyChoice{{}, height};
  return fail(
      ErrorKind::invalidArgument,
      fmt::format("'{}' names no storey; give its number as `acentric storeys` lists it, or its height "
                  "with the unit, such as 3.2m",
                  text.substr(0, 40)),
      "storey");
}

Result<WalkPlane> chooseStorey(const Storeys& storeys, const StoreyChoice& choice) {
  const auto refuse = [&](const std::string& what) {
    return fail(ErrorKind::notFound,
                fmt::format("there is no storey {}; there are: {}", what, listOf(storeys)), "storey");
  };
  if (choice.number) {
    if (std::size_t(*choice.number) >= storeys.planes.size())
      return refuse(fmt::format("{}", *choice.number));
    return storeys.planes[std::size_t(*choice.number)];
  }
  require(choice.height.has_value(), "a storey is chosen by number or by height");
  const auto away = [&](const WalkPlane& plane) { return std::abs(plane.height - *choice.height); };
  const auto nearest = std::ranges::min_element(storeys.planes, {}, away);
  if (nearest == storeys.planes.end() || away(*nearest) > kNearHeight)
    return refuse(fmt::format("within {:g} m of {:g} m", kNearHeight, *choice.height));
  return *nearest;
}

std::string describeStorey(const Storeys& storeys, int number) {
  const WalkPlane& plane = storeys.planes[std::size_t(number)];
  std::vector<int> joined;
  for (const StoreyLink& link : storeys.links) {
    if (link.lower == number) joined.push_back(link.upper);
    if (link.upper == number) joined.push_back(link.lower);
  }
  std::ranges::sort(joined);
  const auto repeated = std::ranges::unique(joined);
  joined.erase(repeated.begin(), repeated.end());
  return fmt::format("{}: {:.2f} m, {:.1f} m2, {:.0f} % covered, {:.0f} % enclosed{}", number, plane.height,
                     plane.outline.area(), 100 * plane.coveredShare, 100 * plane.enclosure,
                     joined.empty() ? "" : fmt::format(", joined to {}", fmt::join(joined, ", ")));
}

Outline tidied(Outline outline) {
  for (auto& loop : outline.loops)
    for (glm::dvec2& corner : loop) corner = glm::round(corner * 1e3) / 1e3;
  return outline;
}

Result<Outline> findOutlineAt(const RayScene& rays, double floorHeight, double eyeHeight) {
  WalkableOptions options;
  options.floorHeight = floorHeight;
  options.eyeHeight = eyeHeight;
  auto area = findWalkableArea(rays.scene().bounds, options, probeFor(rays));
  if (!area) return tl::unexpected(area.error());
  return tidied(std::move(area->outline));
}

Result<Storeys> findSceneStoreys(const RayScene& rays, const StoreyOptions& options) {
  return findStoreys(rays.scene().bounds, options, probeFor(rays));
}

Result<Storeys> findFileStoreys(const std::filesystem::path& file, const ImportOptions& import,
                                const StoreyOptions& options, const ImportHost& host,
                                const Progress& progress, std::stop_token stop) {
  if (file.extension() == ".json") {
    const auto open = openProject(file, host, progress, stop);
    if (!open) return tl::unexpected(open.error());
    return findSceneStoreys(*open->rays, options);
  }
  const auto scene = importScene(file, import, host, progress, stop);
  if (!scene) return tl::unexpected(scene.error());
  const auto rays = RayScene::build(*scene, planEffects(**scene));
  if (!rays) return tl::unexpected(rays.error());
  if (progress) progress({0, 0, "finding the storeys"});
  return findSceneStoreys(**rays, options);
}

}  // namespace acentric
