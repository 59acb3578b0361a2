#include <fmt/format.h>

#include <array>
#include <charconv>

#include "engine/cli/bake_notice.h"
#include "engine/cli/commands.h"
#include "engine/cli/region_report.h"
#include "engine/geometry/conventions.h"
#include "engine/measure/source_colours.h"
#include "engine/pipeline/ask_picture.h"

namespace acentric::cli {
namespace {

constexpr std::size_t kImprovements = 3;

Result<glm::ivec2> chosenPixel(const std::string& text, const PerspectiveView& view) {
  if (text.empty()) return glm::ivec2(view.width / 2, view.height / 2);
  glm::ivec2 pixel(-1);
  const char* const end = text.data() + text.size();
  const auto [comma, first] = std::from_chars(text.data(), end, pixel.x);
  const bool two = first == std::errc{} && comma != end && *comma == ',';
  const auto [last, second] =
      two ? std::from_chars(comma + 1, end, pixel.y) : std::from_chars(end, end, pixel.y);
  if (second != std::errc{} || last != end || pixel.x < 0 || pixel.y < 0 || pixel.x >= view.width ||
      pixel.y >= view.height)
    return fail(ErrorKind::invalidArgument,
                fmt::format("--pixel '{}': give column,row within {}x{}, such as {},{}", text, view.width,
                            view.height, view.width / 2, view.height / 2));
  return pixel;
}

std::string colourText(const Rgba8& c) { return fmt::format("({}, {}, {})", c.r, c.g, c.b); }

std::string layerText(int layer) { return layer == 0 ? "" : fmt::format(", layer {}", layer); }

std::string errorText(const Attribution& errors) {
  std::string text = fmt::format("{:.1f} dB", errors.psnr());
  for (std::size_t s = 0; s < kErrorSources; ++s)
    if (const double share = errors.share(ErrorSource(s)); share >= 0.005)
      text += fmt::format("; {} {:.0f} %", wordsFor(ErrorSource(s)), 100 * share);
  return text;
}

std::string textOf(const PictureAnswer& answer, const OpenProject& open) {
  std::string text = fmt::format("pixel ({}, {}): {}", answer.pixel.x, answer.pixel.y,
                                 sourceName(*open.layout, answer.source));
  if (const auto& painter = answer.painter)
    text += fmt::format("{}, {:.2f} m away, {:.1f}° beside the eye, {:.2f} samples per pixel",
                        layerText(painter->layer), painter->metres, degrees(painter->radians),
                        painter->samplesPerPixel);
  text += fmt::format("\n  colour {}, truth {}", colourText(answer.shown), colourText(answer.truth));
  if (answer.surface) {
    const glm::dvec3& at = answer.surface->position;
    const Mesh& mesh = open.scene->meshOf(answer.surface->mesh);
    text += fmt::format("\n  surface {} at ({:.2f}, {:.2f}, {:.2f}) m",
                        mesh.name.empty() ? "without a name" : mesh.name, at.x, at.y, at.z);
  }
  if (answer.region >= 0) {
    text +=
        fmt::format("\n  eye in {}, {} triangles of local geometry",
                    placeText(open.layout->regions[std::size_t(answer.region)]), countText(answer.triangles));
    if (const int most = open.project.budget.trianglesPerRegion; most > 0)
      text += fmt::format(" of {}", countText(std::uint64_t(most)));
  }
  return text +
         fmt::format("\n  error around it (within {} pixels): {}\n", kAskedPixels, errorText(answer.here));
}

Json errorJson(const Attribution& errors) {
  Json sources = Json::object();
  for (std::size_t s = 0; s < kErrorSources; ++s)
    sources[nameOf(ErrorSource(s))] = errors.share(ErrorSource(s));
  return {{"psnr", errors.psnr()}, {"sources", std::move(sources)}};
}

Json colourJson(const Rgba8& c) { return Json::array({c.r, c.g, c.b}); }

Json jsonOf(const PictureAnswer& answer, const OpenProject& open) {
  Json json = {{"eye", toJson(answer.view.eye)},
               {"pixel", {answer.pixel.x, answer.pixel.y}},
               {"source", sourceName(*open.layout, answer.source)},
               {"colour", colourJson(answer.shown)},
               {"truth", colourJson(answer.truth)},
               {"around", errorJson(answer.here)}};
  if (const auto& painter = answer.painter)
    json["painter"] = {{"camera", painter->camera},
                       {"layer", painter->layer},
                       {"metres", painter->metres},
                       {"degrees", degrees(painter->radians)},
                       {"samplesPerPixel", painter->samplesPerPixel}};
  if (answer.surface)
    json["surface"] = {{"mesh", open.scene->meshOf(answer.surface->mesh).name},
                       {"position", toJson(answer.surface->position)}};
  if (answer.region >= 0) {
    json["region"] = toJson(open.layout->regions[std::size_t(answer.region)]);
    json["triangles"] = answer.triangles;
    json["budget"] = open.project.budget.trianglesPerRegion;
  }
  return json;
}

void addImprovements(const std::vector<Improvement>& improvements, Report& report) {
  Json list = Json::array();
  report.text += improvements.empty() ? "nothing that can be set promises more around it\n"
                                      : "what would improve it, as predicted:\n";
  for (const Improvement& each : improvements) {
    list.push_back(
        {{"change", each.what}, {"why", each.why}, {"psnr", each.psnrHere}, {"bake", toJson(each.bake)}});
    report.text += fmt::format("  {:.1f} dB  {} ({}): {}\n", each.psnrHere, each.what, each.why,
                               each.bake.nothing() ? "all of it is baked" : describe(each.bake));
  }
  report.json["improvements"] = std::move(list);
}

}  // namespace

Result<Report> runAsk(const AskOptions& options, const Common& common) {
  const auto current = openChosen(options.project, common);
  if (!current) return tl::unexpected(current.error());
  const auto view = chosenView(options, *current);
  if (!view) return tl::unexpected(view.error());
  const auto pixel = chosenPixel(options.pixel, *view);
  if (!pixel) return tl::unexpected(pixel.error());
  const auto storeys = storeysFor(options, *current, common);
  if (!storeys) return tl::unexpected(storeys.error());
  const auto runner = common.runner();
  auto maker =
      FrameMaker::create(*storeys, nameOf(withoutOpenGl(current->project.view.renderer)), common, *runner);
  if (!maker) return tl::unexpected(maker.error());
  const auto frame = (*maker)->render(*view);
  if (!frame) return tl::unexpected(frame.error());
  const OpenProject& open = (*storeys)[storeyAt(*storeys, view->eye)];
  if (common.progress) common.progress({0, 0, "asking the picture"});
  const auto answer =
      askPicture(open, (*maker)->walkAt(view->eye)->walk, *frame, *view, *pixel, *runner, common.stop);
  if (!answer) return tl::unexpected(answer.error());
  Report report{jsonOf(*answer, open), textOf(*answer, open)};
  for (const std::string& warning : (*maker)->warnings()) report.text += "warning: " + warning + "\n";
  if (!options.improvements) return report;
  const auto improvements = improvementsOf(open, *answer, kImprovements, common.host, *runner, common.stop);
  if (!improvements) return tl::unexpected(improvements.error());
  addImprovements(*improvements, report);
  return report;
}

}  // namespace acentric::cli
