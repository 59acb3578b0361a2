/// bundle.json -> Bundle.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/export/bundle_read.h"
#include "engine/export/checked_json.h"
#include "engine/geometry/conventions.h"
#include "engine/geometry/predicates/orientation.h"

namespace acentric {
namespace {

using namespace bundle_words;
using Node = CheckedJson;

constexpr double kFarthest = 1e9;  // metres
constexpr std::size_t kMaxListed = 100'000, kMaxCameras = 2'000'000, kMaxPieces = 1000, kMaxCorners = 360,
                      kMaxOutline = 1'000'000;
constexpr int kMaxStoreys = 200;
constexpr std::uint64_t kMaxFileBytes = std::uint64_t(4) << 30;
constexpr int kMaxTextureSide = 65536;
constexpr std::int64_t kMaxTexturePixels = std::int64_t(1) << 28;

template <int Size, class T = double>
glm::vec<Size, T> vectorOf(const Node& node, double low = -kFarthest, double high = kFarthest) {
  node.list(Size, Size);
  glm::vec<Size, T> out;
  for (int i = 0; i < Size; ++i) out[i] = T(node[std::size_t(i)].number(low, high));
  return out;
}

std::vector<glm::dvec2> pointsOf(const Node& node, std::size_t least, std::size_t most) {
  node.list(least, most);
  std::vector<glm::dvec2> points;
  for (std::size_t i = 0; i < node.size(); ++i) points.push_back(vectorOf<2>(node[i]));
  return points;
}

BundleFile fileOf(const Node& node) {
  BundleFile file;
  const Node path = node["file"];
  file.path = path.text(1000);
  const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == '\\' || c == ':'; };
  bool sound = !file.path.empty() && std::ranges::none_of(file.path, control);
  for (std::size_t at = 0; sound && at <= file.path.size();) {
    const std::size_t end = std::min(file.path.find('/', at), file.path.size());
    const std::string_view part = std::string_view(file.path).substr(at, end - at);
    sound = !part.empty() && part != "." && part != "..";
    at = end + 1;
  }
  if (!sound) path.refuse("is no path within the bundle's folder");
  file.bytes = std::uint64_t(node["bytes"].integer(1, std::int64_t(kMaxFileBytes)));
  const auto hash = ContentKey::fromHex(node["hash"].text(32));
  if (!hash) node["hash"].refuse("must be 32 hexadecimal digits");
  file.hash = *hash;
  return file;
}

std::optional<BundleCapture> captureOf(const Node& node) {
  if (node.isNull()) return std::nullopt;
  BundleCapture capture;
  capture.file = fileOf(node);
  capture.columns = int(node["columns"].integer(1, 65535));
  capture.rows = int(node["rows"].integer(1, 65535));
  capture.samples = std::uint64_t(node["samples"].integer(0, std::int64_t(kMaxCaptureSamples)));
  capture.reflections = std::uint64_t(node["reflections"].integer(0, std::int64_t(kMaxCaptureSamples)));
  return capture;
}

void readCamera(const Node& node, LayoutCamera& camera, BundleCamera& renditions) {
  camera.position = vectorOf<2>(node["position"]);
  camera.lowAzimuth = node["lowAzimuth"].number(-100, 100);
  camera.fovRadians = node["fov"].number(1e-6, kPi);
  camera.roles.resize(kRoleBits);
  renditions.topElevation = node["topElevation"].number(-kPi, kPi);
  renditions.bottomElevation = node["bottomElevation"].number(-kPi, kPi);
  renditions.full = captureOf(node["full"]);
  renditions.coarse = captureOf(node["coarse"]);
}

BorderLine lineOf(const Node& node) {
  node.list(2, 2);
  const BorderLine line{vectorOf<2>(node[std::size_t(0)]), vectorOf<2>(node[std::size_t(1)])};
  if (!(glm::length(line.direction()) > 0)) node.refuse("its points are one");
  return line;
}

HalfPlane halfPlaneOf(const Node& node) { return {lineOf(node["line"]), node["left"].boolean()}; }

int roleOf(const Node& node) {
  const auto bits = node.integer(1, 255);
  if (bits == 0xff) return -1;
  for (int role = 0; role < kRoleBits; ++role)
    if (bits == 1 << role) return role;
  node.refuse("must be one bit, or 255");
}

Cover coverOf(const Node& node, std::size_t cameras) {
  Cover cover;
  cover.hand = Hand(node["hand"].word(kHands));
  const Node pieces = node["pieces"];
  pieces.list(1, kMaxPieces);
  cover.wedges = int(node["wedges"].integer(0, std::int64_t(pieces.size())));
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const Node from = pieces[p];
    Piece piece;
    piece.camera = int(from["camera"].integer(0, std::int64_t(cameras) - 1));
    piece.apex = vectorOf<2>(from["apex"]);
    piece.low = lineOf(from["low"]);
    piece.high = lineOf(from["high"]);
    if (from.has("clip")) {
      piece.clip = Clip{halfPlaneOf(from["clip"])};
      if (from["clip"].has("claim")) piece.clip->claim = halfPlaneOf(from["clip"]["claim"]);
    }
    piece.role = roleOf(from["roles"]);
    cover.pieces.push_back(std::move(piece));
  }
  return cover;
}

std::vector<Cover> coversOf(const Node& node, std::size_t least, std::size_t most, std::size_t cameras) {
  node.list(least, most);
  std::vector<Cover> covers;
  for (std::size_t c = 0; c < node.size(); ++c) covers.push_back(coverOf(node[c], cameras));
  return covers;
}

ConvexPolygon polygonOf(const Node& node) {
  ConvexPolygon polygon{pointsOf(node, 3, kMaxCorners)};
  const auto& c = polygon.corners;
  for (std::size_t i = 0; i < c.size(); ++i)
    if (c[i] == c[(i + 1) % c.size()] || orientation(c[i], c[(i + 1) % c.size()], c[(i + 2) % c.size()]) < 0)
      node.refuse("must be convex and counter-clockwise");
  if (!(polygon.area() > 0)) node.refuse("must have an area");
  return polygon;
}

std::optional<BundleLocal> localOf(const Node& node) {
  if (node.isNull()) return std::nullopt;
  return BundleLocal{fileOf(node), std::uint64_t(node["triangles"].integer(1, std::int64_t(1) << 31))};
}

void readRegion(const Node& node, std::size_t regions, BundleStorey& storey) {
  Region region;
  region.kind = RegionKind(node["kind"].word(kKinds));
  region.polygon = polygonOf(node["polygon"]);
  region.grown = polygonOf(node["grown"]);
  const std::size_t cameras = storey.layout.cameras.size();
  region.covers = coversOf(node["covers"], 1, 2, cameras);
  storey.layout.panoramas.push_back(coversOf(node["panoramas"], 0, kMaxPieces, cameras));
  const Node near = node["neighbours"];
  near.list(0, regions);
  storey.neighbours.emplace_back();
  for (std::size_t n = 0; n < near.size(); ++n)
    storey.neighbours.back().push_back(int(near[n].integer(0, std::int64_t(regions) - 1)));
  storey.local.push_back(localOf(node["local"]));
  storey.layout.regions.push_back(std::move(region));
}

BundleStorey storeyOf(const Node& node) {
  BundleStorey storey;
  storey.name = node["name"].text();
  LayoutSpec& spec = storey.layout.spec;
  spec.floorHeight = node["floorHeight"].number(-kFarthest, kFarthest);
  spec.eyeHeight = node["eyeHeight"].number(-kFarthest, kFarthest);
  spec.nearBand = node["nearBand"].number(0, kFarthest);
  if (node.has("slope")) {
    const Node slope = node["slope"];
    spec.slope = GroundSlope{vectorOf<2>(slope["at"]), vectorOf<2>(slope["rise"])};
    if (!(glm::length(spec.slope->rise) <= kSteepestGround))
      slope["rise"].refuse(fmt::format("is steeper than {:g} m per metre", kSteepestGround));
  }
  storey.start = vectorOf<2>(node["start"]["position"]);
  storey.startYaw = node["start"]["yaw"].number(-kFarthest, kFarthest);
  const Node outline = node["outline"];
  outline.list(0, kMaxListed);
  for (std::size_t l = 0; l < outline.size(); ++l)
    spec.outline.loops.push_back(pointsOf(outline[l], 3, kMaxOutline));
  const Node cameras = node["cameras"], regions = node["regions"];
  cameras.list(0, kMaxCameras);
  regions.list(0, std::size_t(kMaxRegions));
  storey.layout.cameras.resize(cameras.size());
  storey.cameras.resize(cameras.size());
  for (std::size_t c = 0; c < cameras.size(); ++c)
    readCamera(cameras[c], storey.layout.cameras[c], storey.cameras[c]);
  for (std::size_t r = 0; r < regions.size(); ++r) readRegion(regions[r], regions.size(), storey);
  return storey;
}

TextureUse useOf(const Node& node, std::size_t textures) {
  TextureUse use;
  if (node.isNull()) return use;
  use.texture = int(node["texture"].integer(0, std::int64_t(textures) - 1));
  use.uvSet = std::uint8_t(node["uvSet"].integer(0, 1));
  const Node rows = node["transform"];
  rows.list(2, 2);
  for (int row = 0; row < 2; ++row) {
    const auto values = vectorOf<3, float>(rows[std::size_t(row)]);
    for (int column = 0; column < 3; ++column) use.transform[column][row] = values[column];
  }
  return use;
}

Material materialOf(const Node& node, std::size_t textures) {
  Material m;
  m.name = node["name"].text();
  m.baseColour = vectorOf<4, float>(node["baseColour"], 0, 1e9);
  m.baseColourTexture = useOf(node["baseColourTexture"], textures);
  m.emissive = vectorOf<3, float>(node["emissive"], 0, 1e30);
  m.emissiveTexture = useOf(node["emissiveTexture"], textures);
  m.metallic = float(node["metallic"].number(0, 1));
  m.roughness = float(node["roughness"].number(0, 1));
  m.transmission = float(node["transmission"].number(0, 1));
  m.alphaMode = AlphaMode(node["alphaMode"].word(kAlphaModes));
  m.alphaCutoff = float(node["alphaCutoff"].number(-1e9, 1e9));
  m.doubleSided = node["doubleSided"].boolean();
  m.unlit = node["unlit"].boolean();
  return m;
}

BundleTexture textureOf(const Node& node) {
  BundleTexture texture;
  texture.file = fileOf(node);
  texture.width = int(node["width"].integer(1, kMaxTextureSide));
  texture.height = int(node["height"].integer(1, kMaxTextureSide));
  if (std::int64_t(texture.width) * texture.height > kMaxTexturePixels)
    node["height"].refuse("makes a texture of more than 2^28 pixels");
  texture.wrapU = Wrap(node["wrapU"].word(kWraps));
  texture.wrapV = Wrap(node["wrapV"].word(kWraps));
  constexpr const char* kFilters[] = {"linear", "nearest"};
  texture.nearest = node["filter"].word(kFilters) == 1;
  constexpr const char* kSpaces[] = {"sRGB"};
  node["colourSpace"].word(kSpaces);
  return texture;
}

BundlePose poseOf(const Node& node) {
  return {vectorOf<3>(node["eye"]), node["yaw"].number(-kFarthest, kFarthest),
          node["pitch"].number(-kPi / 2, kPi / 2), 0};
}

ViewSettings viewOf(const Node& node) {
  ViewSettings view;
  const auto reconstruction = parseReconstruction(reconstructionNow(node["reconstruction"].text()));
  if (!reconstruction) node["reconstruction"].refuse(reconstruction.error().message);
  view.reconstruction = *reconstruction;
  view.maxSplatPixels = int(node["maxSplatPixels"].integer(1, 64));
  view.localGeometry = node["localGeometry"].boolean();
  view.secondaryCover = node["secondaryCover"].boolean();
  view.fillHoles = node["fillHoles"].boolean();
  return view;
}

/// Each of a list, by `make`.
template <class Make>
auto listOf(const Node& node, std::size_t most, const Make& make) {
  node.list(0, most);
  std::vector<decltype(make(node))> out;
  out.reserve(node.size());
  for (std::size_t i = 0; i < node.size(); ++i) out.push_back(make(node[i]));
  return out;
}

void readFeatures(const Node& node, BundleFeatures& features) {
  features.layered = node["layered"].boolean();
  features.blended = node["blended"].boolean();
  features.mirrors = node["mirrors"].boolean();
  features.background = node["background"].boolean();
  features.light = node["light"].boolean();
}

void readWalks(const Node& root, Bundle& bundle) {
  const auto storey = [&](const Node& node) {
    return int(node["storey"].integer(0, std::int64_t(bundle.storeys.size()) - 1));
  };
  bundle.storey = storey(root);
  bundle.bookmarks = listOf(root["bookmarks"], kMaxListed, [&](const Node& node) {
    return BundleBookmark{node["name"].text(), storey(node), poseOf(node), node["fov"].number(1e-3, kPi)};
  });
  bundle.paths = listOf(root["paths"], kMaxListed, [&](const Node& node) {
    return BundlePath{node["name"].text(), storey(node),
                      listOf(node["poses"], kMaxOutline, [](const Node& from) {
                        BundlePose pose = poseOf(from);
                        pose.seconds = from["seconds"].number(0, kFarthest);
                        return pose;
                      })};
  });
}

Bundle bundleOf(const Node& root) {
  if (root["format"].text() != kBundleFormat) root["format"].refuse("is no Acentric bundle");
  const auto version = root["version"].integer(0, 1 << 30);
  if (version != kBundleVersion)
    root["version"].refuse(
        fmt::format("is {}, and this program reads {}: export the walk anew", version, kBundleVersion));
  Bundle bundle;
  bundle.generator = root["generator"].text();
  bundle.name = root["name"].text();
  bundle.origin = vectorOf<3>(root["origin"], -1e15, 1e15);
  bundle.exposure = float(root["exposure"].number(1e-12, 1e12));
  constexpr const char* kCurves[] = {kToneCurve};
  root["toneCurve"].word(kCurves);
  bundle.fov = root["fov"].number(1e-3, kPi);
  bundle.view = viewOf(root["view"]);
  const Node sky = root["sky"], bounds = root["bounds"];
  bundle.sky = {vectorOf<3, float>(sky["zenith"], 0, 1e30), vectorOf<3, float>(sky["horizon"], 0, 1e30),
                vectorOf<3, float>(sky["ground"], 0, 1e30)};
  if (!bounds.isNull())
    bundle.bounds = {vectorOf<3, float>(bounds["min"]), vectorOf<3, float>(bounds["max"])};
  readFeatures(root["features"], bundle.features);
  bundle.textures = listOf(root["textures"], kMaxListed, textureOf);
  bundle.materials = listOf(root["materials"], kMaxListed,
                            [&](const Node& node) { return materialOf(node, bundle.textures.size()); });
  bundle.mirrors = listOf(root["mirrors"], FlatMirrors::kMaxPlanes, [](const Node& node) {
    return MirrorPlane{vectorOf<3, float>(node["normal"], -2, 2), vectorOf<3, float>(node["point"])};
  });
  root["storeys"].list(1, std::size_t(kMaxStoreys));
  bundle.storeys = listOf(root["storeys"], std::size_t(kMaxStoreys), storeyOf);
  readWalks(root, bundle);
  return bundle;
}

}  // namespace

Result<Bundle> parseBundle(const std::string& text, const std::string& where) {
  return parseChecked<Bundle>(text, where, bundleOf);
}

}  // namespace acentric
