/// The C library over a bundle: frames, streaming, errors, data.

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <set>

#include "engine/base/file.h"
#include "engine/capi/acentric_runtime.h"
#include "engine/export/walk_write.h"
#include "tests/export/small_walk.h"

namespace acentric {
namespace {

namespace fs = std::filesystem;

class CapiTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    room = fs::temp_directory_path() / ("acentric-capi-test-" + std::to_string(::getpid()));
    fs::create_directories(room);
    runner = new TaskRunner(1);
    project = new OpenProject(test::bakedProject(room / "walk.acentric.json", *runner));
    const auto written = exportBundle({project, 1}, room / "bundle", {false, "", kLosslessColours}, *runner);
    ASSERT_TRUE(written) << written.error().describe();
  }
  static void TearDownTestSuite() {
    fs::remove_all(room);
    delete runner;
    delete project;
  }
  void SetUp() override {
    ASSERT_EQ(acentric_open_folder((room / "bundle").c_str(), &bundle), ACENTRIC_OK)
        << acentric_message(bundle);
  }
  void TearDown() override { acentric_close(bundle); }

  static acentric_view viewOf(const PerspectiveView& v) {
    return {{v.eye.x, v.eye.y, v.eye.z}, v.yawRadians, v.pitchRadians, v.fovRadians, v.width, v.height};
  }
  acentric_view startView(int width = 160, int height = 100) {
    acentric_view view;
    EXPECT_EQ(acentric_start_view(bundle, &view), ACENTRIC_OK);
    view.width = width, view.height = height;
    return view;
  }
  std::vector<std::uint8_t> draw(const acentric_view& view, const acentric_settings* settings = nullptr) {
    std::vector<std::uint8_t> rgba(std::size_t(view.width) * std::size_t(view.height) * 4);
    const acentric_picture picture{rgba.data(), 0, nullptr, nullptr};
    EXPECT_EQ(acentric_render(bundle, &view, settings, &picture), ACENTRIC_OK) << acentric_message(bundle);
    return rgba;
  }

  static inline fs::path room;
  static inline TaskRunner* runner = nullptr;
  static inline OpenProject* project = nullptr;
  acentric_bundle* bundle = nullptr;
};

TEST_F(CapiTest, DrawsTheFramesOfTheProject) {
  const auto loaded = loadWalk(*project, nullptr, *runner);
  ASSERT_TRUE(loaded) << loaded.error().describe();
  acentric_settings settings;
  ASSERT_EQ(acentric_default_settings(bundle, &settings), ACENTRIC_OK);
  constexpr Renderer kRenderer[] = {Renderer::list, Renderer::scalar, Renderer::zbuffer};
  for (const std::int32_t renderer : {ACENTRIC_LIST, ACENTRIC_SCALAR, ACENTRIC_ZBUFFER})
    for (const int threads : {1, 3})
      for (const PerspectiveView& view : test::everyView(*project->layout)) {
        ViewSettings same = project->project.view;
        same.renderer = kRenderer[renderer], settings.renderer = renderer;
        FrameMemory memory;
        const auto expected = renderFrame(loaded->walk, view, same, *runner, memory);
        ASSERT_TRUE(expected);
        const acentric_view seen = viewOf(view);
        ASSERT_EQ(acentric_set_threads(bundle, threads), ACENTRIC_OK);
        ASSERT_EQ(acentric_load_view(bundle, &seen, &settings, ACENTRIC_FULL), ACENTRIC_OK)
            << acentric_message(bundle);
        const std::size_t pixels = std::size_t(view.width) * std::size_t(view.height),
                          rowBytes = 4 * 160 + 12;
        std::vector<std::uint8_t> rgba(rowBytes * std::size_t(view.height)), holes(pixels);
        std::vector<float> zDepth(pixels);
        const acentric_picture picture{rgba.data(), rowBytes, holes.data(), zDepth.data()};
        ASSERT_EQ(acentric_render(bundle, &seen, &settings, &picture), ACENTRIC_OK);
        for (int y = 0; y < view.height; ++y)
          ASSERT_EQ(std::memcmp(rgba.data() + std::size_t(y) * rowBytes, &expected->colour.at(0, y), 4 * 160),
                    0)
              << "renderer " << renderer << ", row " << y;
        const ColourImage mask = expected->holeMask();
        for (std::size_t i = 0; i < pixels; ++i) {
          ASSERT_EQ(holes[i], mask.pixels[i].r);
          const float inverse = holes[i] == 0 ? memory.inverseZDepth.pixels[i] : 0;
          ASSERT_EQ(zDepth[i], inverse > 0 ? 1 / inverse : std::numeric_limits<float>::infinity());
        }
      }
}

TEST_F(CapiTest, DescribesTheBundle) {
  acentric_info info;
  ASSERT_EQ(acentric_get_info(bundle, &info), ACENTRIC_OK);
  EXPECT_STREQ(info.name, "walk");
  EXPECT_EQ(info.storeys, 1);
  EXPECT_EQ(info.exposure, 0.8f);
  EXPECT_EQ(info.features & unsigned(ACENTRIC_MIRRORS), unsigned(ACENTRIC_MIRRORS));
  EXPECT_EQ(info.mirrors, 2);
  acentric_storey storey;
  ASSERT_EQ(acentric_get_storey(bundle, 0, &storey), ACENTRIC_OK);
  EXPECT_EQ(storey.eye_z, project->layout->eyeZ());
  ASSERT_EQ(storey.regions, int(project->layout->regions.size()));
  for (int r = 0; r < storey.regions; ++r) {
    acentric_region region;
    ASSERT_EQ(acentric_get_region(bundle, 0, r, &region), ACENTRIC_OK);
    double middle[2] = {0, 0};
    for (int c = 0; c < region.corners; ++c)
      middle[0] += region.polygon[2 * c] / region.corners,
          middle[1] += region.polygon[2 * c + 1] / region.corners;
    std::int32_t at = -1;
    EXPECT_EQ(acentric_region_at(bundle, 0, middle, &at), ACENTRIC_OK);
    EXPECT_EQ(at, r);
    EXPECT_GT(region.neighbour_count, 0);
    EXPECT_GT(region.triangles, 0u);
  }
  acentric_camera camera;
  ASSERT_EQ(acentric_get_camera(bundle, 0, storey.cameras - 1, &camera), ACENTRIC_OK);
  EXPECT_EQ(camera.position[0], project->layout->cameras.back().position.x);
  EXPECT_GT(camera.full.samples, camera.coarse.samples);
  acentric_bookmark bookmark;
  ASSERT_EQ(acentric_get_bookmark(bundle, 0, &bookmark), ACENTRIC_OK);
  EXPECT_STREQ(bookmark.name, "the lamp");
  EXPECT_EQ(bookmark.pose.yaw, 0.25);
  acentric_path path;
  ASSERT_EQ(acentric_get_path(bundle, 0, &path), ACENTRIC_OK);
  ASSERT_EQ(path.count, 2);
  EXPECT_EQ(path.poses[1].seconds, 2.5);
  double far[2] = {50, 0};
  std::int32_t none = 0;
  EXPECT_EQ(acentric_region_at(bundle, 0, far, &none), ACENTRIC_ERROR_OUTSIDE);
  EXPECT_EQ(none, -1);
  ASSERT_EQ(acentric_clamp(bundle, 0, far), ACENTRIC_OK);
  EXPECT_EQ(acentric_region_at(bundle, 0, far, &none), ACENTRIC_OK);
}

TEST_F(CapiTest, SaysWhatAViewNeedsAndWhatIsThere) {
  const acentric_view view = startView();
  acentric_needs needs;
  ASSERT_EQ(acentric_view_needs(bundle, &view, nullptr, nullptr, 0, &needs), ACENTRIC_OK);
  ASSERT_GT(needs.count, 3u);
  std::vector<acentric_need> list(needs.count);
  const auto ask = [&] {
    EXPECT_EQ(acentric_view_needs(bundle, &view, nullptr, list.data(), list.size(), &needs), ACENTRIC_OK);
  };
  ask();
  EXPECT_EQ(list.back().kind, ACENTRIC_REGION);
  EXPECT_EQ(list.back().number, needs.region);
  for (const acentric_need& need : list) {
    EXPECT_EQ(need.loaded, ACENTRIC_ABSENT);
    EXPECT_NE(need.roles, 0u);
    EXPECT_EQ(need.roles == 0xff, need.kind == ACENTRIC_REGION);
  }
  ASSERT_EQ(acentric_load_view(bundle, &view, nullptr, ACENTRIC_COARSE), ACENTRIC_OK);
  ask();
  for (const acentric_need& need : list)
    EXPECT_EQ(need.loaded, need.kind == ACENTRIC_CAPTURE ? ACENTRIC_COARSE : ACENTRIC_FULL);
  const auto coarse = draw(view);
  ASSERT_EQ(acentric_load_capture(bundle, needs.storey, list[0].number, ACENTRIC_FULL), ACENTRIC_OK);
  ask();
  EXPECT_EQ(list[0].loaded, ACENTRIC_FULL);
  ASSERT_EQ(acentric_load_view(bundle, &view, nullptr, ACENTRIC_FULL), ACENTRIC_OK);
  EXPECT_NE(draw(view), coarse);
}

TEST_F(CapiTest, CountsMemoryAndKeepsToItsLimit) {
  const acentric_view view = startView();
  EXPECT_EQ(acentric_memory(bundle), 0u);
  ASSERT_EQ(acentric_load_view(bundle, &view, nullptr, ACENTRIC_FULL), ACENTRIC_OK);
  const std::uint64_t all = acentric_memory(bundle);
  EXPECT_GT(all, 100'000u);
  ASSERT_EQ(acentric_load_view(bundle, &view, nullptr, ACENTRIC_FULL), ACENTRIC_OK);
  EXPECT_EQ(acentric_memory(bundle), all) << "nothing is loaded twice";
  acentric_needs needs;
  std::vector<acentric_need> list(100);
  ASSERT_EQ(acentric_view_needs(bundle, &view, nullptr, list.data(), list.size(), &needs), ACENTRIC_OK);
  for (std::size_t i = 0; i < needs.count; ++i)
    if (list[i].kind == ACENTRIC_CAPTURE)
      EXPECT_EQ(acentric_unload_capture(bundle, needs.storey, list[i].number, ACENTRIC_FULL), ACENTRIC_OK);
    else
      EXPECT_EQ(acentric_unload_region(bundle, needs.storey, list[i].number), ACENTRIC_OK);
  EXPECT_EQ(acentric_unload_textures(bundle), ACENTRIC_OK);
  EXPECT_EQ(acentric_memory(bundle), 0u);
  ASSERT_EQ(acentric_set_memory_limit(bundle, all / 2), ACENTRIC_OK);
  EXPECT_EQ(acentric_load_view(bundle, &view, nullptr, ACENTRIC_FULL), ACENTRIC_ERROR_MEMORY);
  EXPECT_NE(std::string(acentric_message(bundle)).find("unload"), std::string::npos);
  EXPECT_LE(acentric_memory(bundle), all / 2);
  draw(view);  // with what is there
  ASSERT_EQ(acentric_set_memory_limit(bundle, 0), ACENTRIC_OK);
  EXPECT_EQ(acentric_load_view(bundle, &view, nullptr, ACENTRIC_FULL), ACENTRIC_OK);
  EXPECT_EQ(acentric_memory(bundle), all);
}

struct Archive {
  std::map<std::string, std::vector<std::byte>> files;
  std::set<std::string> gone;
};

acentric_files filesOf(Archive& archive) {
  acentric_files files;
  files.user = &archive;
  files.size = [](void* user, const char* name, std::uint64_t* bytes) -> acentric_status {
    auto& from = *static_cast<Archive*>(user);
    if (from.gone.contains(name) || !from.files.contains(name)) return ACENTRIC_ERROR_NOT_FOUND;
    *bytes = from.files[name].size();
    return ACENTRIC_OK;
  };
  files.read = [](void* user, const char* name, void* into, std::uint64_t bytes) -> acentric_status {
    const auto& file = static_cast<Archive*>(user)->files[name];
    if (bytes != file.size()) return ACENTRIC_ERROR_UNREADABLE;
    std::memcpy(into, file.data(), file.size());
    return ACENTRIC_OK;
  };
  return files;
}

TEST_F(CapiTest, ReadsFromWhereverTheCallerKeepsFiles) {
  Archive archive;
  for (const auto& entry : fs::recursive_directory_iterator(room / "bundle"))
    if (entry.is_regular_file())
      archive.files[fs::relative(entry.path(), room / "bundle").string()] = *readFile(entry.path());
  const acentric_view view = startView();
  ASSERT_EQ(acentric_load_view(bundle, &view, nullptr, ACENTRIC_FULL), ACENTRIC_OK);
  const auto expected = draw(view);
  acentric_close(bundle);
  const acentric_files files = filesOf(archive);
  ASSERT_EQ(acentric_open_files(&files, &bundle), ACENTRIC_OK) << acentric_message(bundle);
  ASSERT_EQ(acentric_load_view(bundle, &view, nullptr, ACENTRIC_FULL), ACENTRIC_OK)
      << acentric_message(bundle);
  EXPECT_EQ(draw(view), expected);

  std::string pack;
  for (const auto& [name, bytes] : archive.files)
    if (name.starts_with("captures/")) pack = name, archive.gone.insert(name);
  EXPECT_EQ(acentric_unload_capture(bundle, 0, 0, ACENTRIC_FULL), ACENTRIC_OK);
  EXPECT_EQ(acentric_load_capture(bundle, 0, 0, ACENTRIC_FULL), ACENTRIC_ERROR_NOT_FOUND);
  EXPECT_EQ(acentric_load_capture(bundle, 0, 0, ACENTRIC_COARSE), ACENTRIC_OK) << "the walk goes on";
  archive.gone.clear();
  for (auto& [name, bytes] : archive.files)
    if (name.starts_with("captures/")) bytes[bytes.size() / 2] ^= std::byte(1);
  EXPECT_EQ(acentric_load_capture(bundle, 0, 0, ACENTRIC_FULL), ACENTRIC_ERROR_MALFORMED);
  EXPECT_NE(std::string(acentric_message(bundle)).find("captures/"), std::string::npos);
}

TEST_F(CapiTest, OpensAWalkFromDiskAndByRanges) {
  const fs::path walk = room / "room.acentric";
  ASSERT_TRUE(writeWalk(room / "bundle", walk, {3}));
  const acentric_view view = startView();
  ASSERT_EQ(acentric_load_view(bundle, &view, nullptr, ACENTRIC_FULL), ACENTRIC_OK);
  const auto expected = draw(view);
  acentric_close(bundle);
  ASSERT_EQ(acentric_open_walk(walk.c_str(), &bundle), ACENTRIC_OK) << acentric_message(bundle);
  ASSERT_EQ(acentric_load_view(bundle, &view, nullptr, ACENTRIC_FULL), ACENTRIC_OK)
      << acentric_message(bundle);
  EXPECT_EQ(draw(view), expected);
  acentric_close(bundle);

  std::vector<std::byte> bytes = *readFile(walk);
  acentric_ranges ranges;
  ranges.user = &bytes;
  ranges.size = [](void* user, std::uint64_t* size) -> acentric_status {
    *size = static_cast<std::vector<std::byte>*>(user)->size();
    return ACENTRIC_OK;
  };
  ranges.read = [](void* user, std::uint64_t offset, void* into, std::uint64_t count) -> acentric_status {
    const auto& from = *static_cast<std::vector<std::byte>*>(user);
    if (offset > from.size() || count > from.size() - offset) return ACENTRIC_ERROR_UNREADABLE;
    std::memcpy(into, from.data() + offset, count);
    return ACENTRIC_OK;
  };
  ASSERT_EQ(acentric_open_ranges(&ranges, &bundle), ACENTRIC_OK) << acentric_message(bundle);
  ASSERT_EQ(acentric_load_view(bundle, &view, nullptr, ACENTRIC_FULL), ACENTRIC_OK);
  EXPECT_EQ(draw(view), expected);
  // A damaged range names the capture that lies in it.
  for (std::byte& byte : std::span(bytes).last(bytes.size() / 2)) byte ^= std::byte(1);
  int damaged = 0;
  for (int camera = 0; camera < 4; ++camera) {
    acentric_unload_capture(bundle, 0, camera, ACENTRIC_FULL);
    if (acentric_load_capture(bundle, 0, camera, ACENTRIC_FULL) == ACENTRIC_OK) continue;
    ++damaged;
    EXPECT_NE(std::string(acentric_message(bundle)).find("captures/"), std::string::npos);
  }
  EXPECT_GT(damaged, 0);

  acentric_bundle* other = nullptr;
  EXPECT_EQ(acentric_open_walk((room / "none.acentric").c_str(), &other), ACENTRIC_ERROR_NOT_FOUND);
  acentric_close(other);
  EXPECT_EQ(acentric_open_walk((room / "bundle" / "bundle.json").c_str(), &other), ACENTRIC_ERROR_MALFORMED);
  acentric_close(other);
  EXPECT_EQ(acentric_open_ranges(nullptr, &other), ACENTRIC_ERROR_ARGUMENT);
  acentric_close(other);
}

TEST_F(CapiTest, GivesTheDataThatARendererOfOnesOwnNeeds) {
  const acentric_view view = startView();
  acentric_capture_data capture;
  EXPECT_EQ(acentric_get_capture_data(bundle, 0, 0, ACENTRIC_FULL, &capture), ACENTRIC_ERROR_NOT_LOADED);
  ASSERT_EQ(acentric_load_capture(bundle, 0, 0, ACENTRIC_FULL), ACENTRIC_OK);
  ASSERT_EQ(acentric_get_capture_data(bundle, 0, 0, ACENTRIC_FULL, &capture), ACENTRIC_OK);
  acentric_camera camera;
  ASSERT_EQ(acentric_get_camera(bundle, 0, 0, &camera), ACENTRIC_OK);
  EXPECT_EQ(capture.surfaces.count, camera.full.samples);
  EXPECT_EQ(capture.surfaces.column_start[capture.columns], camera.full.samples);
  EXPECT_EQ(capture.reflections.count, camera.full.reflections);
  for (std::uint64_t i = 0; i < capture.surfaces.count; ++i) {
    ASSERT_LT(capture.surfaces.samples[i].row, capture.rows);
    ASSERT_NE(capture.surfaces.samples[i].w_and_roles & 0xff, 0u) << "somebody needs it";
  }
  EXPECT_NEAR(std::hypot(capture.column_direction[0], capture.column_direction[1]), 1, 1e-6);

  acentric_needs needs;
  ASSERT_EQ(acentric_view_needs(bundle, &view, nullptr, nullptr, 0, &needs), ACENTRIC_OK);
  ASSERT_EQ(acentric_load_region(bundle, 0, needs.region), ACENTRIC_OK);
  acentric_region_data region;
  ASSERT_EQ(acentric_get_region_data(bundle, 0, needs.region, &region), ACENTRIC_OK);
  EXPECT_GT(region.meshes, 5);
  bool textured = false, coloured = false, lit = false, mirrored = false;
  for (std::uint64_t t = 0; t < region.triangle_count; ++t) {
    const acentric_local_triangle& triangle = region.triangles[t];
    acentric_mesh_data mesh;
    ASSERT_EQ(acentric_get_mesh_data(bundle, 0, needs.region, std::int32_t(triangle.mesh), &mesh),
              ACENTRIC_OK);
    ASSERT_LT(triangle.source, mesh.triangle_count);
    const std::uint32_t* corners = mesh.triangles + 3 * triangle.source;
    for (const std::uint32_t v : triangle.vertices) {  // a part of its source triangle
      ASSERT_LT(v, region.vertex_count);
      const acentric_local_vertex& at = region.vertices[v];
      const float weights[3] = {1 - at.weights[0] - at.weights[1], at.weights[0], at.weights[1]};
      for (int axis = 0; axis < 3; ++axis) {
        float sum = 0;
        for (int c = 0; c < 3; ++c) sum += weights[c] * mesh.positions[3 * corners[c] + unsigned(axis)];
        ASSERT_NEAR(sum, at.position[axis], 1e-4);
      }
    }
    textured |= mesh.uv0 != nullptr, coloured |= mesh.colours != nullptr;
    mirrored |= mesh.mirror_plane != nullptr && mesh.mirror_plane[triangle.source] != 255;
    lit |= mesh.resolution != nullptr && mesh.resolution[triangle.source] > 0;
  }
  EXPECT_TRUE(textured && coloured && lit && mirrored);
  acentric_texture texture;
  ASSERT_EQ(acentric_get_texture(bundle, 0, &texture), ACENTRIC_OK);
  ASSERT_NE(texture.rgba, nullptr);
  const ColourImage original = test::checks();
  EXPECT_EQ(texture.width, original.width);
  EXPECT_EQ(std::memcmp(texture.rgba, original.pixels.data(), 4 * original.pixels.size()), 0);
  acentric_material material;
  ASSERT_EQ(acentric_get_material(bundle, 0, &material), ACENTRIC_OK);
  EXPECT_EQ(material.base_colour_texture.texture, 0);
  EXPECT_EQ(material.base_colour_texture.rows[0][1], -0.5f);
  acentric_mirror mirror;
  ASSERT_EQ(acentric_get_mirror(bundle, 1, &mirror), ACENTRIC_OK);
  EXPECT_NEAR(std::abs(mirror.normal[0]), 1, 1e-6);
}

TEST_F(CapiTest, RefusesWrongArgumentsWithoutHarm) {
  constexpr acentric_status kWrong = ACENTRIC_ERROR_ARGUMENT;
  acentric_view view = startView();
  acentric_settings settings;
  ASSERT_EQ(acentric_default_settings(bundle, &settings), ACENTRIC_OK);
  std::vector<std::uint8_t> rgba(160 * 100 * 4);
  const acentric_picture picture{rgba.data(), 0, nullptr, nullptr};
  acentric_info info;
  acentric_storey storey;
  acentric_camera camera;
  acentric_region region;
  acentric_bookmark bookmark;
  acentric_path path;
  acentric_needs needs;
  acentric_need need;
  acentric_capture_data capture;
  acentric_region_data local;
  acentric_mesh_data mesh;
  acentric_texture texture;
  acentric_material material;
  acentric_mirror mirror;
  double place[3] = {0, 0, 0};
  std::int32_t number;
  for (acentric_bundle* b : {static_cast<acentric_bundle*>(nullptr), bundle}) {
    const std::int32_t n = b == nullptr ? 0 : -1;  // without a handle everything is wrong
    EXPECT_EQ(acentric_get_info(b, b ? nullptr : &info), kWrong);
    EXPECT_EQ(acentric_get_storey(b, n, &storey), kWrong);
    EXPECT_EQ(acentric_get_camera(b, 0, n, &camera), kWrong);
    EXPECT_EQ(acentric_get_region(b, 0, n, &region), kWrong);
    EXPECT_EQ(acentric_get_bookmark(b, n, &bookmark), kWrong);
    EXPECT_EQ(acentric_get_path(b, n, &path), kWrong);
    EXPECT_EQ(acentric_storey_at(b, b ? nullptr : place, &number), kWrong);
    EXPECT_EQ(acentric_region_at(b, n, place, &number), kWrong);
    EXPECT_EQ(acentric_clamp(b, n, place), kWrong);
    EXPECT_EQ(acentric_set_threads(b, n), kWrong);
    EXPECT_EQ(acentric_start_view(b, b ? nullptr : &view), kWrong);
    EXPECT_EQ(acentric_default_settings(b, b ? nullptr : &settings), kWrong);
    EXPECT_EQ(acentric_view_needs(b, b ? nullptr : &view, nullptr, &need, 1, &needs), kWrong);
    EXPECT_EQ(acentric_view_needs(b, &view, nullptr, nullptr, 1, &needs), kWrong);
    EXPECT_EQ(acentric_load_capture(b, 0, n, ACENTRIC_FULL), kWrong);
    EXPECT_EQ(acentric_load_capture(b, 0, 0, n), kWrong);
    EXPECT_EQ(acentric_unload_capture(b, n, 0, ACENTRIC_FULL), kWrong);
    EXPECT_EQ(acentric_load_region(b, 0, n), kWrong);
    EXPECT_EQ(acentric_unload_region(b, 0, n), kWrong);
    EXPECT_EQ(acentric_load_view(b, &view, nullptr, n), kWrong);
    EXPECT_EQ(acentric_render(b, &view, &settings, b ? nullptr : &picture), kWrong);
    EXPECT_EQ(acentric_get_capture_data(b, 0, n, ACENTRIC_FULL, &capture), kWrong);
    EXPECT_EQ(acentric_get_region_data(b, 0, n, &local), kWrong);
    EXPECT_EQ(acentric_get_mesh_data(b, n, 0, 0, &mesh), kWrong);
    EXPECT_EQ(acentric_get_texture(b, n, &texture), kWrong);
    EXPECT_EQ(acentric_get_material(b, n, &material), kWrong);
    EXPECT_EQ(acentric_get_mirror(b, n, &mirror), kWrong);
  }
  EXPECT_EQ(acentric_set_memory_limit(nullptr, 1), kWrong);
  EXPECT_EQ(acentric_unload_textures(nullptr), kWrong);
  EXPECT_EQ(acentric_memory(nullptr), 0u);
  EXPECT_STREQ(acentric_message(nullptr), "");
  acentric_close(nullptr);
  EXPECT_EQ(acentric_get_camera(bundle, 0, 1 << 30, &camera), kWrong);
  EXPECT_EQ(acentric_get_mesh_data(bundle, 0, 0, 0, &mesh), ACENTRIC_ERROR_NOT_LOADED);
  EXPECT_STREQ(acentric_status_name(1234), "unknown");
  EXPECT_EQ(acentric_runtime_version(), std::uint32_t(ACENTRIC_RUNTIME_VERSION));

  const auto refused = [&](auto change) {
    acentric_view wrong = view;
    acentric_settings odd = settings;
    acentric_picture small = picture;
    change(wrong, odd, small);
    return acentric_render(bundle, &wrong, &odd, &small);
  };
  EXPECT_EQ(refused([](auto& v, auto&, auto&) { v.width = 0; }), kWrong);
  EXPECT_EQ(refused([](auto& v, auto&, auto&) { v.height = -5; }), kWrong);
  EXPECT_EQ(refused([](auto& v, auto&, auto&) { v.fov = std::nan(""); }), kWrong);
  EXPECT_EQ(refused([](auto& v, auto&, auto&) { v.eye[0] = std::nan(""); }), kWrong);
  EXPECT_EQ(refused([](auto& v, auto&, auto&) { v.eye[0] = 90; }), ACENTRIC_ERROR_OUTSIDE);
  EXPECT_EQ(refused([](auto&, auto& s, auto&) { s.renderer = 9; }), kWrong);
  EXPECT_EQ(refused([](auto&, auto& s, auto&) { s.reconstruction = -1; }), kWrong);
  EXPECT_EQ(refused([](auto&, auto& s, auto&) { s.max_splat_pixels = 0; }), kWrong);
  EXPECT_EQ(refused([](auto&, auto&, auto& p) { p.row_bytes = 7; }), kWrong);
  EXPECT_EQ(refused([](auto&, auto&, auto& p) { p.rgba = nullptr; }), kWrong);
  EXPECT_EQ(refused([](auto&, auto&, auto&) {}), ACENTRIC_OK) << "nothing is loaded: holes";
}

TEST_F(CapiTest, KeepsTheReasonWhereABundleCannotBeOpened) {
  acentric_bundle* other = nullptr;
  EXPECT_EQ(acentric_open_folder((room / "nowhere").c_str(), &other), ACENTRIC_ERROR_NOT_FOUND);
  ASSERT_NE(other, nullptr);
  EXPECT_NE(std::string(acentric_message(other)).find("bundle.json"), std::string::npos);
  acentric_info info;
  EXPECT_EQ(acentric_get_info(other, &info), ACENTRIC_ERROR_ARGUMENT);
  acentric_close(other);
  EXPECT_EQ(acentric_open_folder(nullptr, &other), ACENTRIC_ERROR_ARGUMENT);
  acentric_close(other);
  EXPECT_EQ(acentric_open_folder("x", nullptr), ACENTRIC_ERROR_ARGUMENT);
  EXPECT_EQ(acentric_open_files(nullptr, &other), ACENTRIC_ERROR_ARGUMENT);
  acentric_close(other);
  Archive archive;
  const char text[] = "{\"format\": \"acentric bundle\", \"version\": 7}";
  const auto* bytes = reinterpret_cast<const std::byte*>(text);
  archive.files["bundle.json"].assign(bytes, bytes + sizeof text - 1);
  const acentric_files files = filesOf(archive);
  EXPECT_EQ(acentric_open_files(&files, &other), ACENTRIC_ERROR_MALFORMED);
  EXPECT_NE(std::string(acentric_message(other)).find("/version"), std::string::npos);
  acentric_close(other);
}

}  // namespace
}  // namespace acentric
