/// Bundle -> bundle.json.

#include "engine/export/bundle.h"
#include "engine/export/bundle_json.h"

namespace acentric {
namespace {

using Json = BundleJson;
using namespace bundle_words;

template <int N, class T, glm::qualifier Q>
Json toJson(const glm::vec<N, T, Q>& v) {
  Json out = Json::array();
  for (int i = 0; i < N; ++i) out.push_back(double(v[i]));
  return out;
}

// Of what there are lists.
Json toJson(const BundleBookmark& bookmark);
Json toJson(const BundlePath& path);
Json toJson(const BundleTexture& texture);
Json toJson(const Material& material);
Json toJson(const MirrorPlane& plane);
Json toJson(const BundleStorey& storey);

template <class T>
Json listOf(const std::vector<T>& values) {
  Json out = Json::array();
  for (const T& value : values) out.push_back(toJson(value));
  return out;
}

Json toJson(const BundleFile& file) {
  return {{"file", file.path}, {"bytes", file.bytes}, {"hash", file.hash.toHex()}};
}

Json toJson(const std::optional<BundleCapture>& capture) {
  if (!capture) return nullptr;
  Json out = toJson(capture->file);
  out["columns"] = capture->columns, out["rows"] = capture->rows;
  out["samples"] = capture->samples, out["reflections"] = capture->reflections;
  return out;
}

Json toJson(const std::optional<BundleLocal>& local) {
  if (!local) return nullptr;
  Json out = toJson(local->file);
  out["triangles"] = local->triangles;
  return out;
}

Json toJson(const BorderLine& line) { return Json::array({toJson(line.from), toJson(line.to)}); }

Json toJson(const HalfPlane& side) { return {{"line", toJson(side.line)}, {"left", side.left}}; }

Json toJson(const Cover& cover, const Layout& layout) {
  Json pieces = Json::array();
  for (const Piece& piece : cover.pieces) {
    Json out = {{"camera", piece.camera},
                {"apex", toJson(piece.apex)},
                {"low", toJson(piece.low)},
                {"high", toJson(piece.high)}};
    if (piece.clip) {
      out["clip"] = toJson(piece.clip->side);
      if (piece.clip->claim) out["clip"]["claim"] = toJson(*piece.clip->claim);
    }
    out["roles"] = roleBit(layout.cameras[std::size_t(piece.camera)], piece.role);
    pieces.push_back(std::move(out));
  }
  return {{"hand", kHands[std::size_t(cover.hand)]}, {"wedges", cover.wedges}, {"pieces", std::move(pieces)}};
}

Json toJson(const std::vector<Cover>& covers, const Layout& layout) {
  Json out = Json::array();
  for (const Cover& cover : covers) out.push_back(toJson(cover, layout));
  return out;
}

Json cameraJson(const LayoutCamera& camera, const BundleCamera& renditions) {
  return {{"position", toJson(camera.position)},
          {"lowAzimuth", camera.lowAzimuth},
          {"fov", camera.fovRadians},
          {"topElevation", renditions.topElevation},
          {"bottomElevation", renditions.bottomElevation},
          {"full", toJson(renditions.full)},
          {"coarse", toJson(renditions.coarse)}};
}

Json toJson(const BundleStorey& storey) {
  const Layout& layout = storey.layout;
  Json outline = Json::array(), places = placesJson(storey);
  for (const auto& loop : layout.spec.outline.loops) outline.push_back(listOf(loop));
  Json out{{"name", storey.name},
           {"floorHeight", layout.spec.floorHeight},
           {"eyeHeight", layout.spec.eyeHeight},
           {"eyeZ", layout.eyeZ()},
           {"nearBand", layout.spec.nearBand},
           {"start", {{"position", toJson(storey.start)}, {"yaw", storey.startYaw}}},
           {"outline", std::move(outline)},
           {"cameras", std::move(places["cameras"])},
           {"regions", std::move(places["regions"])}};
  if (const auto& slope = layout.spec.slope)
    out["slope"] = {{"at", toJson(slope->at)}, {"rise", toJson(slope->rise)}};
  return out;
}

Json toJson(const TextureUse& use) {
  if (!use.used()) return nullptr;
  return {{"texture", use.texture},
          {"uvSet", use.uvSet},
          {"transform",
           Json::array({toJson(glm::vec3(use.transform[0][0], use.transform[1][0], use.transform[2][0])),
                        toJson(glm::vec3(use.transform[0][1], use.transform[1][1], use.transform[2][1]))})}};
}

Json toJson(const Material& m) {
  return {{"name", m.name},
          {"baseColour", toJson(m.baseColour)},
          {"baseColourTexture", toJson(m.baseColourTexture)},
          {"emissive", toJson(m.emissive)},
          {"emissiveTexture", toJson(m.emissiveTexture)},
          {"metallic", m.metallic},
          {"roughness", m.roughness},
          {"transmission", m.transmission},
          {"alphaMode", kAlphaModes[std::size_t(m.alphaMode)]},
          {"alphaCutoff", m.alphaCutoff},
          {"doubleSided", m.doubleSided},
          {"unlit", m.unlit}};
}

Json toJson(const BundleTexture& texture) {
  Json out = toJson(texture.file);
  out["width"] = texture.width, out["height"] = texture.height;
  out["wrapU"] = kWraps[std::size_t(texture.wrapU)], out["wrapV"] = kWraps[std::size_t(texture.wrapV)];
  out["filter"] = texture.nearest ? "nearest" : "linear";
  out["colourSpace"] = "sRGB";
  return out;
}

Json toJson(const MirrorPlane& plane) {
  return {{"normal", toJson(plane.normal)}, {"point", toJson(plane.point)}};
}

Json toJson(const BundlePose& pose) {
  return {{"eye", toJson(pose.eye)}, {"yaw", pose.yaw}, {"pitch", pose.pitch}};
}

Json toJson(const BundleBookmark& bookmark) {
  Json out = {{"name", bookmark.name}, {"storey", bookmark.storey}};
  out.update(toJson(bookmark.pose));
  out["fov"] = bookmark.fov;
  return out;
}

Json toJson(const BundlePath& path) {
  Json poses = Json::array();
  for (const BundlePose& pose : path.poses) {
    poses.push_back(toJson(pose));
    poses.back()["seconds"] = pose.seconds;
  }
  return {{"name", path.name}, {"storey", path.storey}, {"poses", std::move(poses)}};
}

Json toJson(const Bounds& bounds) {
  if (bounds.empty()) return nullptr;
  return {{"min", toJson(bounds.min)}, {"max", toJson(bounds.max)}};
}

Json toJson(const ViewSettings& view) {
  return {{"reconstruction", nameOf(view.reconstruction)},
          {"maxSplatPixels", view.maxSplatPixels},
          {"localGeometry", view.localGeometry},
          {"secondaryCover", view.secondaryCover},
          {"fillHoles", view.fillHoles}};
}

Json toJson(const BundleFeatures& f) {
  return {{"layered", f.layered},
          {"blended", f.blended},
          {"mirrors", f.mirrors},
          {"background", f.background},
          {"light", f.light}};
}

}  // namespace

Json placesJson(const BundleStorey& storey) {
  const Layout& layout = storey.layout;
  Json cameras = Json::array(), regions = Json::array();
  for (std::size_t c = 0; c < layout.cameras.size(); ++c)
    cameras.push_back(cameraJson(layout.cameras[c], storey.cameras[c]));
  for (std::size_t r = 0; r < layout.regions.size(); ++r) {
    const Region& region = layout.regions[r];
    regions.push_back({{"kind", kKinds[std::size_t(region.kind)]},
                       {"polygon", listOf(region.polygon.corners)},
                       {"grown", listOf(region.grown.corners)},
                       {"neighbours", storey.neighbours[r]},
                       {"local", toJson(storey.local[r])},
                       {"covers", toJson(region.covers, layout)},
                       {"panoramas", toJson(layout.panoramas[r], layout)}});
  }
  return {{"cameras", std::move(cameras)}, {"regions", std::move(regions)}};
}

std::string formatBundle(const Bundle& bundle) {
  return layOut(
      {{"format", kBundleFormat},
       {"version", kBundleVersion},
       {"generator", bundle.generator},
       {"name", bundle.name},
       {"units", "metre"},
       {"axes",
        {{"up", "+Z"}, {"handedness", "right"}, {"azimuth", "counter-clockwise from +X seen from above"}}},
       {"angles", "radian"},
       {"origin", toJson(bundle.origin)},
       {"exposure", bundle.exposure},
       {"toneCurve", kToneCurve},
       {"fov", bundle.fov},
       {"view", toJson(bundle.view)},
       {"sky",
        {{"zenith", toJson(bundle.sky.zenith)},
         {"horizon", toJson(bundle.sky.horizon)},
         {"ground", toJson(bundle.sky.ground)}}},
       {"bounds", toJson(bundle.bounds)},
       {"features", toJson(bundle.features)},
       {"storey", bundle.storey},
       {"bookmarks", listOf(bundle.bookmarks)},
       {"paths", listOf(bundle.paths)},
       {"textures", listOf(bundle.textures)},
       {"materials", listOf(bundle.materials)},
       {"mirrors", listOf(bundle.mirrors)},
       {"storeys", listOf(bundle.storeys)}});
}

}  // namespace acentric
