#include <epoxy/gl.h>

#include <algorithm>
#include <array>

#include "engine/view_gl/capture_residency.h"
#include "engine/view_gl/gl_check.h"
#include "gl_fixture.h"
#include "tests/view/analytic_scene.h"

namespace acentric {
namespace {

class GlResources : public test::WithGl {};

std::shared_ptr<const DisplayCapture> smallCapture(int columns = 8) {
  ColumnCamera camera;
  camera.centreOfProjection = {0, 0, 1.6};
  camera.fovRadians = radians(60);
  camera.topElevation = radians(40);
  camera.bottomElevation = -radians(40);
  camera.columns = columns;
  camera.rows = 16;
  return std::make_shared<const DisplayCapture>(
      prepareForDisplay(test::capture(test::randomPatches(1, 10, 2), camera, nullptr), 1));
}

TEST_F(GlResources, TheContextNamesItsDriverAndVersion) {
  EXPECT_NE(context_->description().find("OpenGL 4."), std::string::npos) << context_->description();
}

TEST_F(GlResources, ACaptureIsUploadedOnceAndDroppedWithItsScene) {
  CaptureResidency residency;
  const auto dropGone = [&](const WalkScene& scene) {
    CaptureSet inScene;
    addTo(inScene, scene.captures);
    residency.dropGone(inScene);
  };
  WalkScene scene;
  scene.captures = {smallCapture(), smallCapture(5)};
  const auto first = residency.get(scene.captures[0], "first");
  ASSERT_TRUE(first);
  const GLuint buffer = (*first)->patchCovers.name();
  EXPECT_EQ(glIsBuffer(buffer), GL_TRUE);
  EXPECT_EQ(*residency.get(scene.captures[0], "first"), *first) << "the same buffers again";
  ASSERT_TRUE(residency.get(scene.captures[1], "second"));
  EXPECT_EQ(residency.count(), 2u);
  const std::size_t runs =
      scene.captures[0]->background.runs.runCount() + scene.captures[1]->background.runs.runCount();
  EXPECT_GT(runs, 0u);
  std::size_t expected = 8 * runs;
  for (const auto& capture : scene.captures) expected += 8 * capture->patches->cover.size();
  EXPECT_EQ(residency.bytes(), expected);

  auto reflecting = std::make_shared<DisplayCapture>(*scene.captures[1]);
  reflecting->reflections = smallCapture();
  scene.captures.push_back(reflecting);
  ASSERT_TRUE(residency.get(reflecting->reflections, "what its mirrors show"));
  dropGone(scene);
  EXPECT_EQ(residency.count(), 3u);
  scene.captures.pop_back();
  dropGone(scene);
  EXPECT_EQ(residency.count(), 2u);

  scene.captures[0] = nullptr;
  dropGone(scene);
  EXPECT_EQ(residency.count(), 1u);
  EXPECT_EQ(glIsBuffer(buffer), GL_FALSE);
  scene.captures.clear();
  dropGone(scene);
  EXPECT_EQ(residency.bytes(), 0u);
}

TEST_F(GlResources, TrimmingDropsWhatWasUnusedLongest) {
  CaptureResidency residency;
  const auto a = smallCapture(), b = smallCapture(), c = smallCapture();
  ASSERT_TRUE(residency.get(a, "a"));
  residency.trim(std::size_t(1) << 30);
  ASSERT_TRUE(residency.get(b, "b"));
  residency.trim(std::size_t(1) << 30);
  ASSERT_TRUE(residency.get(c, "c"));
  ASSERT_TRUE(residency.get(a, "a"));
  const std::size_t one = residency.bytes() / 3;
  residency.trim(2 * one);  // b is the oldest
  EXPECT_EQ(residency.count(), 2u);
  EXPECT_EQ(residency.bytes(), 2 * one);
  ASSERT_TRUE(residency.get(c, "c"));
  residency.trim(0);  // what this frame used stays
  EXPECT_EQ(residency.count(), 1u);
}

TEST_F(GlResources, ACaptureBeyondTheDriversLimitIsRefused) {
  const auto capture = smallCapture();
  CaptureResidency narrow(4 * capture->patches->cover.size() - 1), wide(4 * capture->patches->cover.size());
  const auto tooSmall = narrow.get(capture, "capture of camera 3");
  ASSERT_FALSE(tooSmall);
  EXPECT_EQ(tooSmall.error().kind, ErrorKind::tooLarge);
  EXPECT_EQ(tooSmall.error().where, "capture of camera 3");
  EXPECT_TRUE(wide.get(capture, "capture of camera 3"));
}

TEST_F(GlResources, ACaptureWhoseArraysContradictEachOtherIsRefused) {
  const auto sound = smallCapture();
  const auto refused = [&](auto&& spoil) {
    auto spoilt = std::make_shared<DisplayCapture>(*sound);
    auto patches = std::make_shared<DisplayPatches>(*sound->patches);
    spoil(*spoilt, *patches);
    spoilt->patches = patches;
    const auto begun = CaptureUpload::begin(spoilt, "capture of camera 7", std::size_t(1) << 20);
    return !begun && begun.error().where == "capture of camera 7" &&
           begun.error().kind == ErrorKind::malformed;
  };
  EXPECT_FALSE(refused([](DisplayCapture&, DisplayPatches&) {}));
  EXPECT_TRUE(refused([](DisplayCapture&, DisplayPatches& p) { p.cover.pop_back(); }));
  EXPECT_TRUE(refused([](DisplayCapture&, DisplayPatches& p) { p.colour.pop_back(); }));
  EXPECT_TRUE(refused([](DisplayCapture&, DisplayPatches& p) { p.patches.back().rows += 1; }));
  EXPECT_TRUE(refused([](DisplayCapture& c, DisplayPatches&) { c.background.runs.columnStart.back() += 1; }));
  EXPECT_TRUE(refused([](DisplayCapture& c, DisplayPatches&) { c.background.runs.roles.pop_back(); }));
  EXPECT_TRUE(refused([](DisplayCapture& c, DisplayPatches&) { c.background.runs.endRow.pop_back(); }));
}

TEST_F(GlResources, TheRendererLeavesNoObjectBehind) {
  const auto layout = test::layoutAroundOrigin(Configuration::e);
  const WalkScene scene =
      test::walkScene(test::randomPatches(2, 20, 3.1), layout, *layout->regionAt({0.1, 0.1}), 1);
  PerspectiveView view;
  view.eye = {0.1, 0.1, layout->eyeZ()};
  view.width = 64, view.height = 48;
  ViewSettings settings;
  onGl(scene, view, settings);
  view.width = 80;  // makes the framebuffer anew
  onGl(scene, view, settings);
  EXPECT_EQ(glIsTexture(renderer_->colourTexture()), GL_TRUE);
  renderer_.reset();
  int left = 0;
  for (GLuint name = 1; name < 2000; ++name)
    left += glIsTexture(name) + glIsBuffer(name) + glIsFramebuffer(name) + glIsProgram(name) +
            glIsShader(name) + glIsVertexArray(name) + glIsSampler(name) + glIsQuery(name);
  EXPECT_EQ(left, 0);
}

TEST_F(GlResources, TheColourTextureHoldsTheFrameBottomUp) {
  const auto layout = test::layoutAroundOrigin(Configuration::e);
  const WalkScene scene =
      test::walkScene(test::randomPatches(2, 20, 3.1), layout, *layout->regionAt({0.1, 0.1}), 1);
  PerspectiveView view;
  view.eye = {0.1, 0.1, layout->eyeZ()};
  view.width = 50, view.height = 30;
  const Frame frame = onGl(scene, view, {});
  std::vector<Rgba8> texels(frame.colour.pixels.size());
  glBindTexture(GL_TEXTURE_2D, renderer_->colourTexture());
  glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
  glBindTexture(GL_TEXTURE_2D, 0);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x)
      ASSERT_EQ(texels[std::size_t((view.height - 1 - y) * view.width + x)], frame.colour.at(x, y));
}

TEST_F(GlResources, TheHostsStateIsAsItWas) {
  // What a user interface might have set, none of it a default.
  GLuint texture = 0, buffer = 0, vertexArray = 0, sampler = 0;
  glGenTextures(1, &texture);
  glGenBuffers(1, &buffer);
  glGenVertexArrays(1, &vertexArray);
  glGenSamplers(1, &sampler);
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D, texture);
  glBindSampler(1, sampler);
  glBindVertexArray(vertexArray);
  glBindBuffer(GL_ARRAY_BUFFER, buffer);
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, buffer);
  glBufferData(GL_SHADER_STORAGE_BUFFER, 4096, nullptr, GL_STATIC_DRAW);
  glBindBufferRange(GL_SHADER_STORAGE_BUFFER, 2, buffer, 1024, 2048);
  glEnable(GL_BLEND);
  glEnable(GL_SCISSOR_TEST);
  glEnable(GL_CULL_FACE);
  glBlendFuncSeparate(GL_ONE, GL_ONE_MINUS_SRC_ALPHA, GL_DST_COLOR, GL_ZERO);
  glBlendEquationSeparate(GL_FUNC_SUBTRACT, GL_MAX);
  glDepthFunc(GL_NOTEQUAL);
  glDepthMask(GL_FALSE);
  glColorMask(GL_TRUE, GL_FALSE, GL_TRUE, GL_FALSE);
  glStencilFunc(GL_LEQUAL, 3, 0x7f);
  glStencilOp(GL_INVERT, GL_INCR, GL_DECR);
  glFrontFace(GL_CW);
  glViewport(3, 4, 55, 66);
  glPixelStorei(GL_PACK_ROW_LENGTH, 77);
  glClearColor(0.1f, 0.2f, 0.3f, 0.4f);

  const auto state = [] {
    std::vector<GLint64> values;
    for (GLenum name : {GL_ACTIVE_TEXTURE,
                        GL_TEXTURE_BINDING_2D,
                        GL_SAMPLER_BINDING,
                        GL_VERTEX_ARRAY_BINDING,
                        GL_ARRAY_BUFFER_BINDING,
                        GL_SHADER_STORAGE_BUFFER_BINDING,
                        GL_BLEND,
                        GL_SCISSOR_TEST,
                        GL_CULL_FACE,
                        GL_DEPTH_TEST,
                        GL_STENCIL_TEST,
                        GL_FRAMEBUFFER_SRGB,
                        GL_PROGRAM_POINT_SIZE,
                        GL_BLEND_SRC_RGB,
                        GL_BLEND_DST_RGB,
                        GL_BLEND_SRC_ALPHA,
                        GL_BLEND_DST_ALPHA,
                        GL_BLEND_EQUATION_RGB,
                        GL_BLEND_EQUATION_ALPHA,
                        GL_DEPTH_FUNC,
                        GL_DEPTH_WRITEMASK,
                        GL_STENCIL_FUNC,
                        GL_STENCIL_REF,
                        GL_STENCIL_VALUE_MASK,
                        GL_STENCIL_WRITEMASK,
                        GL_STENCIL_FAIL,
                        GL_STENCIL_BACK_FUNC,
                        GL_STENCIL_BACK_PASS_DEPTH_PASS,
                        GL_FRONT_FACE,
                        GL_CULL_FACE_MODE,
                        GL_PACK_ROW_LENGTH,
                        GL_PACK_ALIGNMENT,
                        GL_DRAW_FRAMEBUFFER_BINDING,
                        GL_READ_FRAMEBUFFER_BINDING,
                        GL_CURRENT_PROGRAM,
                        GL_CLIP_DEPTH_MODE,
                        GL_CLIP_ORIGIN,
                        GL_PROVOKING_VERTEX}) {
      GLint64 value = 0;
      glGetInteger64v(name, &value);
      values.push_back(value);
    }
    std::array<GLint, 4> four{};
    glGetIntegerv(GL_VIEWPORT, four.data());
    values.insert(values.end(), four.begin(), four.end());
    glGetIntegerv(GL_COLOR_WRITEMASK, four.data());
    values.insert(values.end(), four.begin(), four.end());
    GLint64 range = 0;
    glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_START, 2, &range);
    values.push_back(range);
    glGetInteger64i_v(GL_SHADER_STORAGE_BUFFER_SIZE, 2, &range);
    values.push_back(range);
    std::array<GLfloat, 4> colour{};
    glGetFloatv(GL_COLOR_CLEAR_VALUE, colour.data());
    for (GLfloat c : colour) values.push_back(GLint64(1000 * c + 0.5f));
    return values;
  };
  const std::vector<GLint64> before = state();
  const auto layout = test::layoutAroundOrigin(Configuration::e);
  const WalkScene scene =
      test::walkScene(test::randomPatches(2, 20, 3.1), layout, *layout->regionAt({0.1, 0.1}), 1);
  PerspectiveView view;
  view.eye = {0.1, 0.1, layout->eyeZ()};
  view.width = 64, view.height = 48;
  const Frame dirty = onGl(scene, view, {});
  EXPECT_EQ(state(), before);
  EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));

  // And the picture does not depend on the host's state either.
  renderer_.reset();
  context_.reset();
  SetUp();
  EXPECT_EQ(onGl(scene, view, {}).colour.pixels, dirty.colour.pixels);
}

TEST_F(GlResources, AnErrorOfOurOwnBecomesAFailureAndTheHostsDoesNot) {
  glEnable(GL_TEXTURE_2D_ARRAY);  // not a switch: GL_INVALID_ENUM
  const Status ours = checkGl("testing");
  ASSERT_FALSE(ours);
  EXPECT_NE(ours.error().message.find("GL_INVALID_ENUM while testing"), std::string::npos)
      << ours.error().message;
  EXPECT_TRUE(checkGl("testing"));

  glEnable(GL_TEXTURE_2D_ARRAY);
  const auto layout = test::layoutAroundOrigin(Configuration::e);
  const WalkScene scene =
      test::walkScene(test::randomPatches(2, 5, 3.1), layout, *layout->regionAt({0.1, 0.1}), 1);
  PerspectiveView view;
  view.eye = {0.1, 0.1, layout->eyeZ()};
  view.width = 32, view.height = 32;
  EXPECT_TRUE(renderer_->draw(scene, view, {}));
}

TEST_F(GlResources, AnEmptyRendererReadsBackAnEmptyFrame) {
  EXPECT_TRUE(renderer_->readBack().colour.empty());
}

}  // namespace
}  // namespace acentric
