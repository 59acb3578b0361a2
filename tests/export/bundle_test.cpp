/// Bundles: what they bring over, and what readers refuse.

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>

#include "engine/base/file.h"
#include "engine/export/bundle_read.h"
#include "engine/export/local_file.h"
#include "engine/measure/compare.h"
#include "tests/export/small_walk.h"
#include "tests/store/temporary_folder.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;

std::map<std::string, std::string> filesIn(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[fs::relative(entry.path(), folder).string()] = *readText(entry.path());
  return files;
}

/// Every bit of colours.
const ExportBundleOptions kExactly{false, "a test", kLosslessColours};

/// Baked once; each test has its own bundles.
class BundleTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    room = fs::temp_directory_path() / ("acentric-bundle-test-" + std::to_string(::getpid()));
    fs::create_directories(room);
    runner = new TaskRunner(1);
    plain = new OpenProject(test::bakedProject(room / "plain.acentric.json", *runner));
    const auto written = exportBundle({plain, 1}, room / "bundle", kExactly, *runner);
    ASSERT_TRUE(written) << written.error().describe();
    report = *written;
  }
  static void TearDownTestSuite() {
    fs::remove_all(room);
    delete runner;
    delete plain;
  }

  /// The index with one text replaced by another.
  static Result<Bundle> parsedWith(const std::string& from, const std::string& to) {
    std::string text = *readText(room / "bundle" / kBundleIndex);
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    if (at != std::string::npos) text.replace(at, from.size(), to);
    return parseBundle(text, "bundle.json");
  }
  static std::string refusal(const std::string& from, const std::string& to) {
    const auto bundle = parsedWith(from, to);
    EXPECT_FALSE(bundle) << to;
    return bundle ? "" : bundle.error().describe();
  }

  static WalkScene walkOf(const fs::path& folder, bool coarse = false) {
    const auto bundle = readBundle(folder);
    EXPECT_TRUE(bundle) << (bundle ? "" : bundle.error().describe());
    if (!bundle) return {};
    const auto files = bundleFolder(folder);
    std::vector<std::shared_ptr<const ColourImage>> images;
    for (const BundleTexture& texture : bundle->textures) {
      auto image = readBundleTexture(*files, texture);
      EXPECT_TRUE(image) << (image ? "" : image.error().describe());
      images.push_back(std::make_shared<const ColourImage>(image.value_or(ColourImage())));
    }
    const BundleStorey& storey = bundle->storeys.front();
    WalkScene walk =
        walkSceneOf(*bundle, std::make_shared<const Layout>(storey.layout), sceneOf(*bundle, images));
    for (std::size_t c = 0; c < storey.cameras.size(); ++c) {
      const auto& file = coarse ? storey.cameras[c].coarse : storey.cameras[c].full;
      if (!file) continue;
      const auto capture = readBundleCapture(*files, storey, c, *file);
      EXPECT_TRUE(capture) << (capture ? "" : capture.error().describe());
      if (capture)
        walk.captures[c] = std::make_shared<const DisplayCapture>(prepareForDisplay(*capture, walk.exposure));
    }
    for (std::size_t r = 0; r < storey.local.size(); ++r) {
      auto local = readBundleLocal(*files, *bundle, storey, r);
      EXPECT_TRUE(local) << (local ? "" : local.error().describe());
      if (local) walk.local[r] = std::make_shared<const LocalGeometry>(std::move(*local));
    }
    return walk;
  }

  static void expectSameFrames(const OpenProject& open, const fs::path& folder) {
    const auto loaded = loadWalk(open, nullptr, *runner);
    ASSERT_TRUE(loaded) << loaded.error().describe();
    const WalkScene walk = walkOf(folder);
    std::set<PixelSource> sources;
    std::uint64_t drawn = 0, triangles = 0;
    for (const Renderer renderer : {Renderer::list, Renderer::scalar, Renderer::zbuffer})
      for (const Reconstruction reconstruction : {Reconstruction::patches, Reconstruction::splat})
        for (const PerspectiveView& view : test::everyView(*open.layout)) {
          ViewSettings settings = open.project.view;
          settings.renderer = renderer, settings.reconstruction = reconstruction;
          const auto expected = renderFrame(loaded->walk, view, settings, *runner);
          const auto actual = renderFrame(walk, view, settings, *runner);
          ASSERT_TRUE(expected && actual);
          ASSERT_EQ(actual->colour.pixels, expected->colour.pixels)
              << nameOf(renderer) << ", " << nameOf(reconstruction) << " from " << view.eye.x << " "
              << view.eye.y << " towards " << view.yawRadians;
          ASSERT_EQ(actual->source.pixels, expected->source.pixels);
          ASSERT_EQ(actual->stats.samplesDrawn, expected->stats.samplesDrawn);
          sources.insert(expected->source.pixels.begin(), expected->source.pixels.end());
          drawn += expected->stats.samplesDrawn, triangles += expected->stats.localTriangles;
        }
    EXPECT_TRUE(sources.contains(kSourceLocal));
    EXPECT_GT(sources.size(), 12u) << "captures are seen";
    EXPECT_GT(drawn, 100'000u);
    EXPECT_GT(triangles, 200u);
  }

  static inline fs::path room;
  static inline TaskRunner* runner = nullptr;
  static inline OpenProject* plain = nullptr;
  static inline BundleReport report;
};

TEST_F(BundleTest, GivesTheFramesOfItsProjectBitForBit) { expectSameFrames(*plain, room / "bundle"); }

TEST_F(BundleTest, GivesTheFramesOfSimplifiedRegions) {
  OpenProject simplified = *plain;  // its captures and light are the same
  simplified.project.budget.trianglesPerRegion = 60;
  simplified.project.budget.maxErrorMetres = 0.2;
  simplified.project.budget.simplify = true;
  const auto written = exportBundle({&simplified, 1}, room / "simple", kExactly, *runner);
  ASSERT_TRUE(written) << written.error().describe();
  EXPECT_LT(written->triangles, report.triangles);
  expectSameFrames(simplified, room / "simple");
}

TEST_F(BundleTest, OfTheUsualQualityShowsItsProjectInFewerBytes) {
  const auto written = exportBundle({plain, 1}, room / "usual", {false, "", kUsualColourQuality}, *runner);
  ASSERT_TRUE(written) << written.error().describe();
  EXPECT_LT(written->fullBytes, report.fullBytes / 2);
  const auto loaded = loadWalk(*plain, nullptr, *runner);
  ASSERT_TRUE(loaded) << loaded.error().describe();
  const WalkScene walk = walkOf(room / "usual");
  for (const PerspectiveView& view : test::everyView(*plain->layout)) {
    const auto expected = renderFrame(loaded->walk, view, plain->project.view, *runner);
    const auto actual = renderFrame(walk, view, plain->project.view, *runner);
    ASSERT_TRUE(expected && actual);
    EXPECT_GT(psnrOf(expected->colour, actual->colour), 42);
  }
}

TEST_F(BundleTest, OfTheUsualQualityHoldsWhatItsRegionsDrawAlone) {
  const auto written = exportBundle({plain, 1}, room / "drawn", {false, "", kUsualColourQuality}, *runner);
  ASSERT_TRUE(written) << written.error().describe();
  EXPECT_LT(written->samples, report.samples) << "the layout's border has neighbours that are not placed";
  const auto bundle = readBundle(room / "drawn");
  ASSERT_TRUE(bundle) << bundle.error().describe();
  const BundleStorey& storey = bundle->storeys.front();
  std::vector<unsigned> drawn(storey.cameras.size());
  for (const Region& region : storey.layout.regions)
    for (const Cover& cover : region.covers)
      for (const Piece& piece : cover.pieces)
        drawn[std::size_t(piece.camera)] |=
            roleBit(storey.layout.cameras[std::size_t(piece.camera)], piece.role);
  for (std::size_t c = 0; c < drawn.size(); ++c) {
    const auto capture = readCapturePack(room / "drawn" / storey.cameras[c].full->file.path);
    ASSERT_TRUE(capture) << capture.error().describe();
    for (const auto* roles : {&capture->roles, &capture->reflections.roles, &capture->background.roles})
      EXPECT_TRUE(std::ranges::none_of(*roles, [&](unsigned bits) { return (bits & ~drawn[c]) != 0; }));
  }
}

TEST_F(BundleTest, SaysWhatItsProjectUses) {
  const auto bundle = readBundle(room / "bundle");
  ASSERT_TRUE(bundle) << bundle.error().describe();
  EXPECT_TRUE(bundle->features.layered && bundle->features.blended && bundle->features.mirrors &&
              bundle->features.light);
  EXPECT_EQ(bundle->name, "plain");
  EXPECT_EQ(bundle->generator, "a test");
  EXPECT_EQ(bundle->exposure, 0.8f);
  EXPECT_EQ(bundle->mirrors.size(), 2u);
  EXPECT_EQ(bundle->textures.size(), 1u);
  ASSERT_EQ(bundle->bookmarks.size(), 1u);
  EXPECT_EQ(bundle->bookmarks[0].name, "the lamp");
  EXPECT_EQ(bundle->bookmarks[0].pose.eye, plain->project.bookmarks[0].eye);
  ASSERT_EQ(bundle->paths.size(), 1u);
  EXPECT_EQ(bundle->paths[0].poses.back().seconds, 2.5);
  const BundleStorey& storey = bundle->storeys.front();
  ASSERT_EQ(storey.layout.regions.size(), plain->layout->regions.size());
  EXPECT_EQ(storey.cameras.size(), plain->layout->cameras.size());
  EXPECT_EQ(storey.start, plain->project.spawn().position);
  for (std::size_t r = 0; r < storey.neighbours.size(); ++r) {
    EXPECT_FALSE(storey.neighbours[r].empty());
    for (const int other : storey.neighbours[r]) {
      const auto& back = storey.neighbours[std::size_t(other)];
      EXPECT_TRUE(std::ranges::find(back, int(r)) != back.end());
    }
  }
  EXPECT_EQ(formatBundle(*bundle), *readText(room / "bundle" / kBundleIndex)) << "read and written again";
}

TEST_F(BundleTest, TellsHowTheGroundOfStairsRises) {
  auto bundle = readBundle(room / "bundle");
  ASSERT_TRUE(bundle);
  LayoutSpec& spec = bundle->storeys.front().layout.spec;
  EXPECT_FALSE(spec.slope) << "level ground";
  spec.slope = {{0.1, -0.2}, {0.5, 0.25}};
  const std::string text = formatBundle(*bundle);
  const auto read = parseBundle(text, "bundle.json");
  ASSERT_TRUE(read) << read.error().describe();
  EXPECT_EQ(read->storeys.front().layout.spec.slope, spec.slope);
  spec.slope->rise = {3, 0};
  const auto steep = parseBundle(formatBundle(*bundle), "bundle.json");
  ASSERT_FALSE(steep);
  EXPECT_NE(steep.error().describe().find("/storeys/0/slope/rise"), std::string::npos)
      << steep.error().describe();
}

TEST_F(BundleTest, HoldsTheStoresCapturesAndCoarseOnesOfThem) {
  const auto store = openCaptures(plain->file);
  ASSERT_TRUE(store);
  const auto bundle = readBundle(room / "bundle");
  ASSERT_TRUE(bundle);
  for (std::size_t c = 0; c < plain->keys.size(); ++c) {
    const BundleCamera& camera = bundle->storeys.front().cameras[c];
    ASSERT_TRUE(camera.full && camera.coarse);
    const auto full = readCapturePack(room / "bundle" / camera.full->file.path);
    ASSERT_TRUE(full) << full.error().describe();
    EXPECT_EQ(*full, *store->get(plain->keys[c]));
    EXPECT_EQ(camera.coarse->columns, (camera.full->columns + 7) / 8);
    EXPECT_LT(camera.coarse->samples, camera.full->samples / 4);
  }
  const WalkScene coarse = walkOf(room / "bundle", true);
  const auto frame =
      renderFrame(coarse, test::everyView(*plain->layout).front(), plain->project.view, *runner);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->stats.missingImages, 0);
}

TEST_F(BundleTest, IsTheSameBytesEachTimeAndHoldsNoPath) {
  const auto again = exportBundle({plain, 1}, room / "again", kExactly, *runner);
  ASSERT_TRUE(again) << again.error().describe();
  const auto first = filesIn(room / "bundle"), second = filesIn(room / "again");
  EXPECT_EQ(first, second);
  std::uint64_t bytes = 0;
  for (const auto& [name, content] : first) {
    bytes += content.size();
    EXPECT_EQ(content.find(room.string()), std::string::npos) << name;
  }
  EXPECT_EQ(bytes, report.bytes());
}

TEST_F(BundleTest, ReplacesABundleAndNothingElse) {
  const fs::path folder = room / "target";
  fs::create_directories(folder);
  EXPECT_TRUE(exportBundle({plain, 1}, folder, {}, *runner)) << "an empty folder";
  std::ofstream(folder / "left over") << "x";
  EXPECT_TRUE(exportBundle({plain, 1}, folder, {}, *runner)) << "a bundle";
  EXPECT_FALSE(fs::exists(folder / "left over"));
  const fs::path other = room / "other";
  fs::create_directories(other);
  std::ofstream(other / "thesis.txt") << "years of work";
  const auto refused = exportBundle({plain, 1}, other, {}, *runner);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().describe().find("no bundle"), std::string::npos);
  EXPECT_TRUE(fs::exists(other / "thesis.txt"));
  for (const auto& entry : fs::directory_iterator(room))
    EXPECT_FALSE(entry.path().filename().string().starts_with(kTemporaryPrefix)) << entry.path();
}

TEST_F(BundleTest, RefusesToLeaveCapturesOutUnlessTold) {
  const OpenProject missing = [&] {
    OpenProject open = *plain;
    open.keys[0].low ^= 1, open.keys[3].low ^= 1;
    return open;
  }();
  const auto refused = exportBundle({&missing, 1}, room / "missing", {}, *runner);
  ASSERT_FALSE(refused);
  const std::string why = refused.error().describe();
  EXPECT_NE(why.find("2 of "), std::string::npos) << why;
  EXPECT_NE(why.find("`acentric bake "), std::string::npos) << why;
  EXPECT_FALSE(fs::exists(room / "missing"));
  const auto told = exportBundle({&missing, 1}, room / "missing", {true, "", std::nullopt}, *runner);
  ASSERT_TRUE(told) << told.error().describe();
  EXPECT_EQ(told->missing, 2u);
  const auto bundle = readBundle(room / "missing");
  ASSERT_TRUE(bundle) << bundle.error().describe();
  EXPECT_FALSE(bundle->storeys[0].cameras[0].full.has_value());
}

TEST_F(BundleTest, StoppedWritesNothing) {
  std::stop_source stop;
  stop.request_stop();
  const auto stopped = exportBundle({plain, 1}, room / "stopped", {}, *runner, {}, stop.get_token());
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().kind, ErrorKind::cancelled);
  EXPECT_FALSE(fs::exists(room / "stopped"));
}

TEST_F(BundleTest, RefusesAnIndexThatIsWrongWithItsPlace) {
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos ? "" : text;
  };
  EXPECT_EQ(has(refusal("acentric bundle", "other"), "/format"), "");
  EXPECT_EQ(has(refusal("\"version\": 4", "\"version\": 5"), "/version"), "");
  EXPECT_EQ(has(refusal("\"exposure\"", "\"exposed\""), "lacks 'exposure'"), "");
  EXPECT_EQ(has(refusal("\"captures/", "\"../"), "/storeys/0/cameras/0/full/file"), "");
  EXPECT_EQ(has(refusal("\"captures/", "\"/tmp/"), "path within"), "");
  EXPECT_EQ(has(refusal("\"captures/", "\"captures\\\\"), "path within"), "");
  EXPECT_EQ(has(refusal("\"camera\": ", "\"camera\": -1, \"was\": "), "/camera: must lie in"), "");
  EXPECT_EQ(has(refusal("\"camera\": ", "\"camera\": 9999, \"was\": "), "/camera: must lie in"), "");
  EXPECT_EQ(has(refusal("\"kind\": \"", "\"kind\": \"x"), "is not known"), "");
  EXPECT_EQ(has(refusal("\"polygon\": [", "\"polygon\": [[1e300,0],"), "/polygon/0/0"), "");
  EXPECT_EQ(has(refusal("\"polygon\": [", "\"polygon\": [[100,100],"), "convex"), "");
  EXPECT_EQ(has(refusal("\"roles\":", "\"roles\":3,\"was\":"), "one bit"), "");
  EXPECT_EQ(has(refusal("{", "{{"), "not JSON"), "");
  EXPECT_TRUE(parsedWith("\"generator\"", "\"from a later version\": [1, {}], \"generator\""));
}

TEST_F(BundleTest, RefusesFilesThatAreNotWhatTheIndexSays) {
  const fs::path folder = room / "damaged";
  fs::copy(room / "bundle", folder, fs::copy_options::recursive);
  const auto bundle = readBundle(folder);
  ASSERT_TRUE(bundle);
  const BundleStorey& storey = bundle->storeys.front();
  const auto files = bundleFolder(folder);
  const auto flip = [&](const std::string& name) {
    std::fstream file(folder / name, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(40);
    file.put('\x7f');
  };
  const BundleCapture& capture = *storey.cameras[0].full;
  flip(capture.file.path);
  const auto damaged = readBundleCapture(*files, storey, 0, capture);
  ASSERT_FALSE(damaged);
  EXPECT_NE(damaged.error().describe().find(capture.file.path), std::string::npos);
  EXPECT_FALSE(readBundleCapture(*files, storey, 0, *storey.cameras[1].full)) << "another camera's";
  flip(bundle->textures[0].file.path);
  EXPECT_FALSE(readBundleTexture(*files, bundle->textures[0]));
  flip(storey.local[0]->file.path);
  EXPECT_FALSE(readBundleLocal(*files, *bundle, storey, 0));
  fs::resize_file(folder / storey.local[1]->file.path, 100);
  EXPECT_FALSE(readBundleLocal(*files, *bundle, storey, 1));
  fs::remove(folder / storey.cameras[2].full->file.path);
  const auto gone = readBundleCapture(*files, storey, 2, *storey.cameras[2].full);
  ASSERT_FALSE(gone);
  EXPECT_EQ(gone.error().kind, ErrorKind::notFound);
}

/// CRC-32 as PNG's chunks end in it.
std::uint32_t crcOf(std::span<const std::byte> bytes) {
  std::uint32_t crc = 0xffffffffu;
  for (const std::byte byte : bytes) {
    crc ^= std::to_integer<std::uint32_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? 0xedb88320u ^ (crc >> 1) : crc >> 1;
  }
  return ~crc;
}

void putBigEndian(std::vector<std::byte>& bytes, std::size_t at, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = std::byte(value >> (24 - 8 * i));
}

TEST_F(BundleTest, RefusesTexturesThatUnpackToMoreThanTheIndexSaysByTheirHeader) {
  const fs::path folder = room / "swollen";
  fs::copy(room / "bundle", folder, fs::copy_options::recursive);
  const auto bundle = readBundle(folder);
  ASSERT_TRUE(bundle);
  BundleTexture texture = bundle->textures[0];
  auto bytes = readFile(folder / texture.file.path).value();
  // The size in the first chunk, which ends in a checksum of its name and its 13 bytes.
  putBigEndian(bytes, 16, 16384);
  putBigEndian(bytes, 20, 16384);
  putBigEndian(bytes, 29, crcOf(std::span(bytes).subspan(12, 17)));
  ASSERT_TRUE(writeFileAtomically(folder / texture.file.path, bytes));
  texture.file.hash = Hasher().bytes(bytes.data(), bytes.size()).finish();
  const auto refused = readBundleTexture(*bundleFolder(folder), texture);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("is 16384 x 16384 pixels large, and the index says"),
            std::string::npos)
      << refused.error().describe();

  // Packs: what their heads say is compared before their samples are unpacked.
  const BundleStorey& storey = bundle->storeys.front();
  BundleCapture capture = *storey.cameras[0].full;
  capture.samples += 1;
  const auto other = readBundleCapture(*bundleFolder(folder), storey, 0, capture);
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().message.find("has another number of samples"), std::string::npos);
}

TEST_F(BundleTest, RefusesLocalFilesWithNumbersOutOfRange) {
  const auto bundle = readBundle(room / "bundle");
  ASSERT_TRUE(bundle);
  const auto read = [&](std::size_t materials, std::size_t mirrors, const LocalGeometry& local) {
    const fs::path file = room / "odd.local";
    EXPECT_TRUE(writeLocalFile(local, file));
    return readLocalFile(*readFile(file), "odd.local", materials, mirrors);
  };
  const auto files = bundleFolder(room / "bundle");
  const LocalGeometry good = readBundleLocal(*files, *bundle, bundle->storeys[0], 0).value();
  const std::size_t materials = bundle->materials.size(), mirrors = bundle->mirrors.size();
  EXPECT_TRUE(read(materials, mirrors, good));
  EXPECT_FALSE(read(1, mirrors, good));
  const auto with = [&](auto change) {
    LocalGeometry local = good;
    auto surfaces = std::make_shared<LocalSurfaces>(*good.surfaces);
    change(local, *surfaces);
    local.surfaces = surfaces;
    return local;
  };
  const auto changed = [&](auto change) { return read(materials, mirrors, with(change)); };
  EXPECT_FALSE(changed([](auto& local, auto&) { local.triangles[0].vertices.x = 1u << 30; }));
  EXPECT_FALSE(changed([](auto& local, auto&) { local.triangles[0].triangle = 1u << 30; }));
  EXPECT_FALSE(changed([](auto& local, auto&) { local.vertices[0].barycentric.x = 7; }));
  EXPECT_FALSE(changed([](auto& local, auto&) { local.vertices[0].position.y = std::nanf(""); }));
  EXPECT_FALSE(changed([](auto&, auto& surfaces) { surfaces.meshes[0].triangles[0].y = 1u << 30; }));
  EXPECT_FALSE(changed([](auto&, auto& surfaces) { surfaces.mirrorPlanes[0][0] = 100; }));
  // Light that cannot be coded is not written in the first place.
  const fs::path odd = room / "odd.local";
  EXPECT_FALSE(writeLocalFile(with([](auto&, auto& all) { all.light.resolution[0] = 60000; }), odd));
  EXPECT_FALSE(writeLocalFile(with([](auto&, auto& all) { all.light.light[0].r = 0x7c00; }), odd));
}

TEST_F(BundleTest, KeepsWholeTrianglesWithoutVerticesOfTheirOwn) {
  auto surfaces = std::make_shared<LocalSurfaces>();
  Mesh mesh;
  mesh.material = 0;
  constexpr int kTriangles = 400;
  LocalGeometry local;
  const auto positionOf = [](int t, int c) {
    return glm::vec3(std::sin(7.0f * float(t) + float(c)), std::cos(5.0f * float(3 * t + c)),
                     0.01f * float(t));
  };
  for (int t = 0; t < kTriangles; ++t) {
    const auto first = std::uint32_t(3 * t);
    for (int c = 0; c < 3; ++c)
      mesh.positions.push_back(positionOf(t, c)), mesh.normals.emplace_back(0, 0, 1);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    // Most are whole; the others begin at another corner, are cut, or lie a little off.
    const int kind = t % 10;
    for (int c = 0; c < 3; ++c) {
      const int corner = kind == 1 ? (c + 1) % 3 : c;
      LocalVertex vertex{positionOf(t, corner), glm::vec2(corner == 1 ? 1 : 0, corner == 2 ? 1 : 0)};
      if (kind == 2 && c == 1) vertex.barycentric.x = 0.5f;
      if (kind == 3 && c == 2) vertex.position.z += 1e-5f;
      local.vertices.push_back(vertex);
    }
    local.triangles.push_back({{first, first + 1, first + 2}, 0, std::uint32_t(t)});
  }
  surfaces->meshes = {mesh};
  local.surfaces = surfaces;
  const auto bytesOf = [&](const LocalGeometry& geometry) {
    EXPECT_TRUE(writeLocalFile(geometry, room / "whole.local"));
    return *readFile(room / "whole.local");
  };
  const auto read = readLocalFile(bytesOf(local), "whole.local", 1, 0);
  ASSERT_TRUE(read) << read.error().describe();
  ASSERT_EQ(read->triangles.size(), local.triangles.size());
  for (std::size_t t = 0; t < local.triangles.size(); ++t) {
    EXPECT_EQ(read->triangles[t].triangle, local.triangles[t].triangle);
    for (int c = 0; c < 3; ++c) {
      const LocalVertex &a = read->vertices[read->triangles[t].vertices[c]],
                        &b = local.vertices[local.triangles[t].vertices[c]];
      EXPECT_EQ(a.position, b.position) << t;
      EXPECT_EQ(a.barycentric, b.barycentric) << t;
    }
  }
  LocalGeometry moved = local;
  for (LocalVertex& vertex : moved.vertices) vertex.position.x += 1;
  EXPECT_LT(4 * bytesOf(local).size(), 3 * bytesOf(moved).size()) << "seven in ten keep no vertices";
}

TEST_F(BundleTest, SurvivesAnyDamageOfItsIndex) {
  const std::string text = *readText(room / "bundle" / kBundleIndex);
  std::size_t refused = 0;
  for (std::size_t i = 0; i < 300; ++i) {
    std::string broken = text;
    broken[(i * 7919) % text.size()] = "0{}[],:\"x-"[i % 10];
    refused += parseBundle(broken, "bundle.json") ? 0 : 1;
    EXPECT_FALSE(parseBundle(text.substr(0, (i * 104729) % (text.size() - 2)), "bundle.json"));
  }
  EXPECT_GT(refused, 100u);
}

}  // namespace
}  // namespace acentric
