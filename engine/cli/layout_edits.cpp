#include "engine/cli/layout_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>

#include "engine/geometry/conventions.h"
#include "engine/layout/density.h"
#include "engine/layout/panoramas.h"

namespace acentric::cli {
namespace {

std::vector<std::string_view> partsOf(std::string_view text) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t comma = text.find(',');
    parts.push_back(text.substr(0, comma));
    if (comma == std::string_view::npos) return parts;
    text.remove_prefix(comma + 1);
  }
}

template <class T>
std::optional<std::vector<T>> numbersFrom(std::span<const std::string_view> parts) {
  std::vector<T> numbers;
  for (const std::string_view part : parts) {
    T value{};
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc() || end != part.data() + part.size()) return std::nullopt;
    if constexpr (std::is_floating_point_v<T>)
      if (!std::isfinite(value)) return std::nullopt;
    numbers.push_back(value);
  }
  return numbers;
}

tl::unexpected<Error> refuse(std::string_view text, const char* expected) {
  return fail(ErrorKind::invalidArgument, fmt::format("'{}' is not {}", text.substr(0, 60), expected),
              "layout");
}

Status applyCells(LayoutSpec& spec, const LayoutEdits& edits) {
  struct Edit {
    const std::vector<std::string>& cells;
    std::set<CellId>& into;
    std::set<CellId>* outOf;
  };
  std::set<CellId> join;
  for (const Edit& edit :
       {Edit{edits.add, spec.added, &spec.removed}, Edit{edits.remove, spec.removed, &spec.added},
        Edit{edits.split, spec.split, nullptr}, Edit{edits.join, join, &spec.split}})
    for (const std::string& text : edit.cells) {
      const auto id = parseCell(text);
      if (!id) return tl::unexpected(id.error());
      edit.into.insert(*id);
      if (edit.outOf != nullptr) edit.outOf->erase(*id);
    }
  for (const std::string& text : edits.density) {
    const auto density = parseDensity(text);
    if (!density) return tl::unexpected(density.error());
    giveDensity(spec, density->first, density->second);
  }
  return {};
}

Status applyFreeApvs(LayoutSpec& spec, const LayoutEdits& edits) {
  for (const int number : edits.removeFree) {
    if (spec.freeApvs.erase(number) == 0)
      return fail(ErrorKind::notFound, fmt::format("there is no free APV {}", number), "layout");
    spec.density.erase({number, 0, kFreeSlot});
  }
  for (const std::string& text : edits.free) {
    const auto apv = parseApv(text);
    if (!apv) return tl::unexpected(apv.error());
    spec.freeApvs[spec.freeApvs.empty() ? 0 : spec.freeApvs.rbegin()->first + 1] = *apv;
  }
  return {};
}

Status applyPanoramas(EditedLayout& edited, const std::string& places) {
  if (places.empty()) return {};
  if (places == "none") {
    edited.notes.push_back(fmt::format("{} free panoramas taken away", removePanoramas(edited.spec)));
    return {};
  }
  const auto added =
      addPanoramas(edited.spec, places == "rings" ? PanoramaPlaces::rings : PanoramaPlaces::regions);
  if (!added) return tl::unexpected(added.error());
  edited.notes.push_back(fmt::format("{} free panoramas placed", *added));
  return {};
}

}  // namespace

Result<glm::dvec2> parsePoint(std::string_view text) {
  const auto parts = partsOf(text);
  const auto numbers = numbersFrom<double>(parts);
  if (!numbers || numbers->size() != 2) return refuse(text, "a point x,y in metres, such as 1.5,-2");
  return glm::dvec2((*numbers)[0], (*numbers)[1]);
}

Result<CellId> parseCell(std::string_view text) {
  const auto parts = partsOf(text);
  const auto n = numbersFrom<int>(parts);
  if (!n || n->size() < 3 || n->size() > 4)
    return refuse(text, "a cell's address i,j,slot or i,j,slot,level; `acentric info --regions` lists them");
  return CellId{(*n)[0], (*n)[1], (*n)[2], n->size() > 3 ? (*n)[3] : 0};
}

Result<std::pair<CellId, double>> parseDensity(std::string_view text) {
  const std::size_t equals = text.find('=');
  const auto id = parseCell(text.substr(0, equals));
  if (!id) return tl::unexpected(id.error());
  const std::string_view factor = equals == std::string_view::npos ? "" : text.substr(equals + 1);
  const auto times = numbersFrom<double>({&factor, 1});
  if (!times) return refuse(text, "a cell's address and a factor: i,j,slot=times, such as 0,1,0=2");
  return std::pair(*id, times->front());
}

Result<Apv> parseApv(std::string_view text) {
  static constexpr const char* kExpected =
      "an APV x,y,dx,dy,fov,hand: centre and offset to the first camera in metres, degrees, ccw or cw, such "
      "as "
      "2,3,0.8,0,60,ccw";
  const auto parts = partsOf(text);
  if (parts.size() != 6) return refuse(text, kExpected);
  const auto numbers = numbersFrom<double>(std::span(parts).first(5));
  const bool clockwise = parts[5] == "cw";
  if (!numbers || (!clockwise && parts[5] != "ccw")) return refuse(text, kExpected);
  const auto& n = *numbers;
  Apv apv{{n[0], n[1]}, {n[2], n[3]}, n[4], clockwise ? Hand::clockwise : Hand::counterClockwise};
  if (Status sound = apv.check(); !sound) return tl::unexpected(sound.error());
  return apv;
}

Result<EditedLayout> applyEdits(const LayoutSpec& spec, const LayoutEdits& edits) {
  EditedLayout edited{spec, {}};
  LayoutSpec& s = edited.spec;
  if (!edits.configuration.empty()) {
    const auto configuration = parseConfiguration(edits.configuration);
    if (!configuration) return tl::unexpected(configuration.error());
    s.configuration = *configuration;
  }
  s.cellSize = edits.cellSize.value_or(s.cellSize);
  if (edits.rotationDegrees) s.rotationRadians = radians(*edits.rotationDegrees);
  s.eyeHeight = edits.eyeHeight.value_or(s.eyeHeight);
  s.nearBand = edits.nearBand.value_or(s.nearBand);
  if (!edits.origin.empty()) {
    const auto origin = parsePoint(edits.origin);
    if (!origin) return tl::unexpected(origin.error());
    s.latticeOrigin = *origin;
  }
  const std::size_t single = s.added.size() + s.removed.size() + s.split.size() + s.density.size();
  if (single > 0 && (s.configuration != spec.configuration || s.cellSize != spec.cellSize)) {
    s.forgetCells();
    edited.notes.push_back(
        fmt::format("{} cells added, removed, split or made denser one by one are forgotten: they belong to "
                    "the former lattice",
                    single - s.density.size()));
  }
  if (Status done = applyCells(s, edits); !done) return tl::unexpected(done.error());
  if (Status done = applyFreeApvs(s, edits); !done) return tl::unexpected(done.error());
  if (Status done = applyPanoramas(edited, edits.panoramas); !done) return tl::unexpected(done.error());
  if (Status sound = s.check(); !sound) return tl::unexpected(sound.error());
  return edited;
}

}  // namespace acentric::cli
