#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/file.h"
#include "engine/cli/commands.h"
#include "engine/cli/path_frames.h"
#include "engine/cli/pruning_report.h"
#include "engine/cli/region_report.h"
#include "engine/inspect/plan_coverage.h"
#include "engine/picture/layout_picture.h"
#include "engine/pipeline/coverage.h"

namespace acentric::cli {
namespace {

constexpr const char* kSurfaceSize = "960x540";
constexpr const char* kFrameSize = "640x360";
constexpr const char* kLookSize = "320x180";

struct PlanBox {
  glm::dvec2 low{std::numeric_limits<double>::max()}, high{std::numeric_limits<double>::lowest()};
  void add(const glm::dvec2& p) { low = glm::min(low, p), high = glm::max(high, p); }
};

PlanBox boxOf(const Layout& layout) {
  PlanBox box;
  for (const Region& region : layout.regions)
    for (const glm::dvec2& corner : region.grown.corners) box.add(corner);
  return box;
}

Status writePicture(const PlanPicture& picture, const std::filesystem::path& path) {
  if (Status written = writePlanPicture(picture, path); !written) return written;
  return mustExist(path);
}

// ---------------------------------------------------------------- plan

PlanPicture pictureOf(const PlanCoverage& coverage, const CoverageShares& shares, const Layout& layout) {
  const PlanGrid& grid = coverage.grid;
  PlanPicture picture = acentric::pictureOf(layout, "Cameras that hold each point");
  for (PlanPolygon& polygon : picture.polygons) polygon.fill.reset();
  std::erase_if(picture.legend, [](const LegendEntry& e) { return e.swatch == LegendSwatch::area; });
  std::uint16_t most = 1;
  for (const std::uint16_t count : coverage.counts)
    if (count != kNotCounted) most = std::max(most, count);
  ColourImage image(grid.columns, grid.rows);
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x) {
      const std::uint16_t count = coverage.counts[grid.indexOf(x, y)];
      image.at(x, grid.rows - 1 - y) = count == 0 ? kAlarmColour : scaleColour(double(count) / most);
    }
  const glm::dvec2 size = grid.step * glm::dvec2(grid.columns, grid.rows);
  picture.rasters.push_back({std::move(image), grid.corner, grid.corner + size});
  picture.scale = PlanScale{"cameras per point", "", 0, double(most), false, {}, {}};
  picture.subtitle = fmt::format("{:.1f} on average, at most {}; {:.2f} % of the area is held by none",
                                 shares.mean, most, 100 * shares.none);
  return picture;
}

Result<std::string> planCsv(const PlanCoverage& coverage) {
  const PlanGrid& grid = coverage.grid;
  std::string csv = "x,y,cameras\n";
  for (int y = 0; y < grid.rows; ++y)
    for (int x = 0; x < grid.columns; ++x) {
      const glm::dvec2 centre = grid.centreOf(x, y);
      csv += fmt::format("{:.6g},{:.6g},{}\n", centre.x, centre.y, coverage.counts[grid.indexOf(x, y)]);
    }
  return csv;
}

Result<Report> coverageOfPlan(const CoverageOptions& options, const Common& common) {
  const auto project = loadProject(options.project);
  if (!project) return tl::unexpected(project.error());
  const auto layout = buildLayout(project->layout());
  if (!layout) return tl::unexpected(layout.error());
  const PlanBox box = boxOf(*layout);
  const auto runner = common.runner();
  const auto coverage = coverageOfLayout(*layout, options.reach > 0 ? options.reach : kAnyDistance,
                                         PlanGrid::over(box.low, box.high, options.grid), *runner);
  if (!coverage) return tl::unexpected(coverage.error());
  const CoverageShares shares = sharesOf(*coverage);

  // The covers, each where its region's eyes look: exactly once, or the layout is wrong.
  Json kinds = Json::array();
  std::string kindText;
  std::vector<RegionKind> seen;
  for (const Region& region : layout->regions) {
    if (std::ranges::find(seen, region.kind) != seen.end()) continue;
    seen.push_back(region.kind);
    const glm::dvec2 centre = region.polygon.centroid(), half(6 * layout->spec.cellSize);
    const PlanGrid around = PlanGrid::over(centre - half, centre + half, 160);
    double once = 1;
    for (const Cover& cover : region.covers) {
      const auto own = coverageOfCover(region, cover, around, *runner);
      if (!own) return tl::unexpected(own.error());
      once = std::min(once, sharesOf(*own).once);
    }
    const auto corners = coverageOfCorners(*layout, region, around, *runner);
    if (!corners) return tl::unexpected(corners.error());
    const CoverageShares atCorners = sharesOf(*corners);
    kinds.push_back({{"kind", nameOf(region.kind)},
                     {"covers", region.covers.size()},
                     {"coverHoldsOnce", once},
                     {"camerasAtCorners", {{"mean", atCorners.mean}, {"byCount", atCorners.byCount}}}});
    kindText += fmt::format(
        "  {:<11} each cover holds {:.2f} % of what is outside exactly once; the cameras at its corners hold "
        "it {:.2f} times on average\n",
        nameOf(region.kind), 100 * once, atCorners.mean);
  }

  Report report;
  report.json = {{"project", options.project.string()},
                 {"regions", layout->regions.size()},
                 {"cameras", layout->cameras.size()},
                 {"grid",
                  {{"columns", coverage->grid.columns},
                   {"rows", coverage->grid.rows},
                   {"step", coverage->grid.step},
                   {"corner", {coverage->grid.corner.x, coverage->grid.corner.y}}}},
                 {"mean", shares.mean},
                 {"none", shares.none},
                 {"once", shares.once},
                 {"more", shares.more},
                 {"byCount", shares.byCount},
                 {"kinds", std::move(kinds)}};
  report.text = fmt::format(
      "{} cameras over {:.0f} square metres ({} x {} points): {:.1f} hold a point on average\n"
      "  none {:.2f} %, one {:.2f} %, more {:.2f} %\n{}",
      layout->cameras.size(), shares.countedArea, coverage->grid.columns, coverage->grid.rows, shares.mean,
      100 * shares.none, 100 * shares.once, 100 * shares.more, kindText);
  if (!options.csv.empty()) {
    const auto csv = planCsv(*coverage);
    if (Status written = writeTextAtomically(options.csv, *csv); !written)
      return tl::unexpected(written.error());
  }
  if (!options.output.empty())
    if (Status written = writePicture(pictureOf(*coverage, shares, *layout), options.output); !written)
      return tl::unexpected(written.error());
  return report;
}

// ---------------------------------------------------------------- surfaces

Rgba8 colourOf(SurfaceClass surfaceClass) {
  switch (surfaceClass) {
    case SurfaceClass::neverSampled:
      return kAlarmColour;
    case SurfaceClass::under:
      return categoryColour(1);
    case SurfaceClass::fine:
      return categoryColour(2);
    case SurfaceClass::over:
      return categoryColour(0);
    case SurfaceClass::local:
    case SurfaceClass::unseen:
      break;
  }
  return kFaintColour;
}

PlanPicture pictureOf(const SurfaceCoverage& coverage, const Layout& layout) {
  PlanPicture picture = acentric::pictureOf(layout, "Sampling of the surfaces, seen from above");
  for (PlanPolygon& polygon : picture.polygons) polygon.fill.reset();
  picture.cameras.clear();
  picture.legend.clear();
  const std::pair<SurfaceClass, const char*> kinds[] = {
      {SurfaceClass::local, "near: only drawn as geometry"},
      {SurfaceClass::over, "over-sampled: more than 2 samples per pixel"},
      {SurfaceClass::fine, "fine: 0.5 to 2 samples per pixel"},
      {SurfaceClass::under, "under-sampled: less than 0.5 samples per pixel"},
      {SurfaceClass::neverSampled, "never sampled: a hole"}};
  for (const auto& [kind, text] : kinds) {  // what is worse lies on top
    picture.legend.push_back({fmt::format("{} ({:.1f} %)", text, 100 * coverage.all.share(kind)),
                              colourOf(kind), LegendSwatch::dot});
    for (const PointCoverage& point : coverage.points)
      if (point.surfaceClass == kind)
        picture.markers.push_back(
            {glm::dvec2(point.point.position), MarkerShape::dot, colourOf(kind), 2.2, {}});
  }
  picture.subtitle =
      fmt::format("{} points on surfaces, {} of them seen", coverage.points.size(), coverage.all.seen);
  return picture;
}

std::string surfaceCsv(const SurfaceCoverage& coverage, const Scene& scene) {
  std::string csv =
      "x,y,z,mesh,material,class,regionsSeeing,regionsMissing,eyesSeeing,eyesMissing,nearestRegion,"
      "nearestMetres,camera,samplesPerMetre,pixelsPerMetre\n";
  for (const PointCoverage& p : coverage.points)
    csv += fmt::format("{:.6g},{:.6g},{:.6g},{},{},{},{},{},{},{},{},{:.5g},{},{:.5g},{:.5g}\n",
                       p.point.position.x, p.point.position.y, p.point.position.z, p.point.mesh,
                       scene.meshOf(p.point.mesh).material, nameOf(p.surfaceClass), p.seenFrom.size(),
                       p.missedFrom.size(), p.eyesSeeing, p.eyesMissing, p.nearestRegion, p.nearestDistance,
                       p.camera, p.samplesPerMetre, p.pixelsPerMetre);
  return csv;
}

Json toJson(const CoverageSummary& summary) {
  Json shares = Json::object();
  for (int k = 1; k < kSurfaceClasses; ++k) shares[nameOf(SurfaceClass(k))] = summary.share(SurfaceClass(k));
  return {{"points", summary.points},
          {"seen", summary.seen},
          {"shares", std::move(shares)},
          {"partlyMissed", summary.seen > 0 ? double(summary.partlyMissed) / double(summary.seen) : 0},
          {"missingShare", summary.missingShare()}};
}

struct NamedMesh {
  std::string name;
};

template <class Things>
Json namedSummaries(const std::vector<CoverageSummary>& summaries, const Things& things) {
  Json out = Json::array();
  for (std::size_t k = 0; k < summaries.size(); ++k)
    if (summaries[k].seen > 0) {
      Json entry = toJson(summaries[k]);
      entry["name"] = things[k].name;
      out.push_back(std::move(entry));
    }
  return out;
}

Json toJson(const SurfaceCoverage& coverage, const Scene& scene, const Layout& layout) {
  Json regions = Json::array(), histogram = Json::array();
  std::vector<NamedMesh> all;
  for (const auto* meshes : {&scene.meshes, &scene.prototypes})
    for (const Mesh& mesh : *meshes) all.push_back({mesh.name});
  for (std::size_t r = 0; r < layout.regions.size(); ++r)
    regions.push_back(
        {{"region", r}, {"seen", coverage.seenByRegion[r]}, {"missed", coverage.missedByRegion[r]}});
  for (int bin = 0; bin < kRatioBins; ++bin)
    histogram.push_back(
        {{"samplesPerPixelFrom", ratioBinStart(bin)}, {"points", coverage.byRatio[std::size_t(bin)]}});
  return {{"points", coverage.points.size()},
          {"squareMetresPerPoint", coverage.squareMetresPerPoint},
          {"all", toJson(coverage.all)},
          {"histogram", std::move(histogram)},
          {"regions", std::move(regions)},
          {"meshes", namedSummaries(coverage.byMesh, all)},
          {"materials", namedSummaries(coverage.byMaterial, scene.materials)}};
}

Result<Report> coverageOfSurfaces(const CoverageOptions& options, const Common& common) {
  const auto size = parseSize(options.size.empty() ? kSurfaceSize : options.size);
  if (!size) return tl::unexpected(size.error());
  const auto open = openChosen(options.project, common);
  if (!open) return tl::unexpected(open.error());
  SurfaceCoverageOptions judging = surfaceCoverageOptionsFor(open->project, size->width);
  judging.points = options.points;
  judging.eyes.perRegion = options.eyesPerRegion;
  const ProjectReach reach(*open);
  const auto runner = common.runner();
  const auto show = [&](const SurfaceCoveragePtr& snapshot) {
    if (common.progress)
      common.progress({double(snapshot->points.size()), double(snapshot->wanted),
                       fmt::format("judging surfaces: {:.2f} % never sampled so far",
                                   100 * snapshot->all.share(SurfaceClass::neverSampled))});
  };
  const auto coverage = measureSurfaceCoverage(open->scene, *reach, judging, *runner, show, common.stop);
  if (!coverage) return tl::unexpected(coverage.error());
  const SurfaceCoverage& c = **coverage;

  Report report;
  report.json = toJson(c, *open->scene, *open->layout);
  report.json["project"] = options.project.string();
  report.json["eyesPerRegion"] = options.eyesPerRegion;
  report.json["displayWidth"] = size->width;
  const auto percent = [&](SurfaceClass k) { return 100 * c.all.share(k); };
  report.text = fmt::format(
      "{} points on surfaces, one per {:.3g} square metres; {} are seen from {} regions ({} eyes each)\n"
      "  never sampled {:6.2f} %   (holes wherever they are seen)\n"
      "  under-sampled {:6.2f} %   (less than 0.5 samples per pixel of a display {} pixels wide)\n"
      "  fine          {:6.2f} %\n"
      "  over-sampled  {:6.2f} %   (more than 2)\n"
      "  near          {:6.2f} %   (only ever drawn as geometry)\n"
      "missed from some regions, not from others: {:.2f} %; of all sights of a point {:.2f} % are missed\n",
      c.points.size(), c.squareMetresPerPoint, c.all.seen, open->layout->regions.size(),
      options.eyesPerRegion, percent(SurfaceClass::neverSampled), percent(SurfaceClass::under), size->width,
      percent(SurfaceClass::fine), percent(SurfaceClass::over), percent(SurfaceClass::local),
      c.all.seen > 0 ? 100 * double(c.all.partlyMissed) / double(c.all.seen) : 0, 100 * c.all.missingShare());
  if (!options.csv.empty())
    if (Status written = writeTextAtomically(options.csv, surfaceCsv(c, *open->scene)); !written)
      return tl::unexpected(written.error());
  if (!options.output.empty())
    if (Status written = writePicture(pictureOf(c, *open->layout), options.output); !written)
      return tl::unexpected(written.error());
  return report;
}

// ---------------------------------------------------------------- correlation

Json toJson(const Correlation& correlation) {
  return {{"pearson", correlation.pearson}, {"spearman", correlation.spearman}};
}

Result<Report> correlation(const CoverageOptions& options, const Common& common) {
  const bool random = options.path.empty();
  const std::string usual = random ? kLookSize : kFrameSize;
  auto walk = openAlong(options.project, options.path, options.size.empty() ? usual : options.size, 0,
                        kTourFrames, common, Along::oneStorey);
  if (!walk) return tl::unexpected(walk.error());
  auto views = evenly(walk->views, options.frames);
  if (random) {
    auto looks = randomLooks(walk->storeys.front(), options.frames > 0 ? options.frames : kTourFrames,
                             walk->size.width, walk->size.height);
    if (!looks) return tl::unexpected(looks.error());
    views = std::move(*looks);
  }
  const auto runner = common.runner();
  auto maker = FrameMaker::create(walk->storeys, options.renderer, common, *runner);
  if (!maker) return tl::unexpected(maker.error());
  const ProjectReach reach(walk->storeys.front());
  const auto result = correlateHoles(
      reach, views, (*maker)->settings, [&](const PerspectiveView& view) { return (*maker)->render(view); },
      *runner, common.progress, common.stop);
  if (!result) return tl::unexpected(result.error());

  Json frames = Json::array();
  std::string csv = "eyeX,eyeY,eyeZ,yawDegrees,missed,open,measured\n";
  double missed = 0, open = 0, measured = 0;
  std::uint64_t holes = 0, predicted = 0, both = 0;
  for (const HoleSample& f : result->frames) {
    frames.push_back({{"eye", cli::toJson(f.view.eye)},
                      {"yawDegrees", degrees(f.view.yawRadians)},
                      {"missed", f.missed},
                      {"open", f.open},
                      {"measured", f.measured},
                      {"missingImages", f.missingImages}});
    csv += fmt::format("{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", f.view.eye.x, f.view.eye.y,
                       f.view.eye.z, degrees(f.view.yawRadians), f.missed, f.open, f.measured);
    missed += f.missed, open += f.open, measured += f.measured;
    holes += f.holes, predicted += f.predicted, both += f.both;
  }
  const double n = double(result->frames.size());
  Report report;
  report.json = {{"project", options.project.string()},
                 {"renderer", options.renderer},
                 {"eyes", result->eyes},
                 {"width", walk->size.width},
                 {"height", walk->size.height},
                 {"missed", toJson(result->missed)},
                 {"open", toJson(result->open)},
                 {"pixels", {{"holes", holes}, {"predicted", predicted}, {"both", both}}},
                 {"frames", std::move(frames)}};
  const auto line = [&](const char* name, double mean, const Correlation& c) {
    return fmt::format("  {:<9} mean {:7.4f} %   Pearson {:6.3f}   Spearman {:6.3f}\n", name, 100 * mean / n,
                       c.pearson, c.spearman);
  };
  report.text =
      fmt::format(
          "{} frames of {}x{} from {} eyes, renderer {}: holes measured, mean {:.4f} %; predicted as\n", n,
          walk->size.width, walk->size.height, result->eyes, options.renderer, 100 * measured / n) +
      line("missed", missed, result->missed) + line("open", open, result->open) +
      fmt::format(
          "  (missed: the surface seen is in no capture; open: nor is anything behind it)\n"
          "{} pixels are holes, {} were predicted as open, {} both\n",
          holes, predicted, both);
  if (!options.csv.empty())
    if (Status written = writeTextAtomically(options.csv, csv); !written)
      return tl::unexpected(written.error());
  return report;
}

}  // namespace

Result<Report> runCoverage(const CoverageOptions& options, const Common& common) {
  if (int(options.plan) + int(options.surfaces) + int(options.pruning) + int(options.correlate) > 1)
    return fail(ErrorKind::invalidArgument, "choose one of --plan, --surfaces, --pruning and --correlate");
  if (options.pruning) {
    if (!options.output.empty() || !options.csv.empty())
      return fail(ErrorKind::invalidArgument,
                  "--pruning has no picture and no CSV; take its figures with --json");
    return lossesOfPruning(options.project, common);
  }
  if (options.correlate) {
    if (!options.output.empty())
      return fail(ErrorKind::invalidArgument, "--correlate has no picture; write its figures with --csv");
    return correlation(options, common);
  }
  return options.plan ? coverageOfPlan(options, common) : coverageOfSurfaces(options, common);
}

}  // namespace acentric::cli
