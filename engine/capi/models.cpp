#include <algorithm>
#include <cmath>

#include "engine/capi/handle.h"
#include "engine/export/patch_model.h"

using namespace acentric;
using namespace acentric::capi;

namespace {

constexpr acentric_status kOk = ACENTRIC_OK;

static_assert(sizeof(Rgba8) == 4);
static_assert(sizeof(acentric_model_vertex) == 28, "vertices lie without gaps");

/// What acentric_free_model frees: a model, with the arrays that it refers to.
struct OwnedModel : acentric_model {
  std::vector<acentric_model_vertex> vertexArray;
  std::vector<uint32_t> indexArray;
  std::vector<acentric_mesh> meshArray;
  std::vector<acentric_image> imageArray;
  std::vector<std::string> names;
  std::vector<DrawTexture> pixels;
};

void addMesh(const DrawMesh& mesh, int texture, OwnedModel& model) {
  const auto code = [](float value) { return uint16_t(std::clamp(value, 0.0F, 1.0F) * 65535 + 0.5F); };
  const auto first = uint32_t(model.vertexArray.size());
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3& at = mesh.positions[i];
    const glm::vec2 uv = mesh.uv.empty() ? glm::vec2(0.5F) : mesh.uv[i];
    const glm::vec3 colour = mesh.colours.empty() ? glm::vec3(1) : mesh.colours[i];
    model.vertexArray.push_back(
        {{at.x, at.y, at.z}, {uv.x, uv.y}, {code(colour.r), code(colour.g), code(colour.b), 65535}});
  }
  const uint64_t firstIndex = model.indexArray.size();
  for (const glm::uvec3& t : mesh.triangles)
    model.indexArray.insert(model.indexArray.end(), {first + t.x, first + t.y, first + t.z});
  model.meshArray.push_back({nullptr,
                             firstIndex,
                             3 * mesh.triangles.size(),
                             texture,
                             int32_t(mesh.alpha),
                             {mesh.factor.r, mesh.factor.g, mesh.factor.b, mesh.factor.a},
                             mesh.alpha == AlphaMode::mask ? mesh.cutoff : 0,
                             mesh.doubleSided,
                             mesh.roles});
  model.names.push_back(mesh.material);
}

const acentric_model* handOut(DrawModel model) {
  auto out = std::make_unique<OwnedModel>();
  out->pixels = std::move(model.textures);
  int white = -1;  // of what has no texture
  for (DrawMesh& mesh : model.meshes) {
    if (mesh.texture < 0 && white < 0) {
      white = int(out->pixels.size());
      out->pixels.push_back({ColourImage(1, 1, Rgba8(255))});
    }
    addMesh(mesh, mesh.texture < 0 ? white : mesh.texture, *out);
    mesh = {};
  }
  for (std::size_t i = 0; i < out->names.size(); ++i) out->meshArray[i].name = out->names[i].c_str();
  for (const DrawTexture& texture : out->pixels)
    out->imageArray.push_back({texture.image.width, texture.image.height, int32_t(texture.wrapU),
                               int32_t(texture.wrapV), texture.nearest,
                               reinterpret_cast<const uint8_t*>(texture.image.pixels.data())});
  for (int i = 0; i < 3; ++i) out->origin[i] = model.origin[i];
  out->vertex_count = out->vertexArray.size(), out->index_count = out->indexArray.size();
  out->vertices = out->vertexArray.data(), out->indices = out->indexArray.data();
  out->mesh_count = int32_t(out->meshArray.size()), out->texture_count = int32_t(out->imageArray.size());
  out->meshes = out->meshArray.data(), out->textures = out->imageArray.data();
  return out.release();
}

/// Is the full capture's model in use, of a coarse one's?
bool hasBetter(const acentric_bundle& bundle, LoadJob job) {
  if (job.region || job.detail == Loaded::full) return false;
  job.detail = Loaded::full;
  return bundle.handedOut.contains(job);
}

bool isTextureSize(int32_t pixels) { return pixels >= kLeastAtlas && pixels <= kLargestAtlas; }
constexpr const char* kTextureSize = "texture_pixels: 128 to 16384";

}  // namespace

acentric_status acentric_make_model(acentric_bundle* bundle, int32_t storey, int32_t kind, int32_t number,
                                    int32_t detail, int32_t texture_pixels, const acentric_model** model) {
  if (model != nullptr) *model = nullptr;
  return guarded(bundle, [&](BundlePlayer& runtime) {
    if (model == nullptr) return refused(bundle, "model is NULL");
    if (!hasStorey(runtime, storey)) return refused(bundle, "no such storey");
    if (!isTextureSize(texture_pixels)) return refused(bundle, kTextureSize);
    const auto of = std::size_t(storey), its = std::size_t(number);
    Result<DrawModel> made;
    if (kind == ACENTRIC_REGION) {
      if (!hasRegion(runtime, storey, number)) return refused(bundle, "no such region");
      const auto place = runtime.places().placeOfRegion(of, its);
      if (!place) return failed(*bundle, place.error());
      made = regionModel(*place, *(*place)->regionIn(its), texture_pixels, runtime.images());
    } else if (kind == ACENTRIC_CAPTURE) {
      if (!hasCamera(runtime, storey, number) || wrongDetail(detail) != nullptr)
        return refused(bundle, "no such capture");
      const auto place = runtime.places().placeOfCamera(of, its);
      if (!place) return failed(*bundle, place.error());
      made = captureModel(**place, *(*place)->cameraIn(its), Loaded(detail), texture_pixels);
    } else {
      return refused(bundle, "kind: ACENTRIC_CAPTURE or ACENTRIC_REGION");
    }
    if (!made) return failed(*bundle, made.error());
    *model = handOut(std::move(*made));
    return kOk;
  });
}

void acentric_free_model(const acentric_model* model) { delete static_cast<const OwnedModel*>(model); }

acentric_status acentric_request_models(acentric_bundle* bundle, const acentric_view* view,
                                        const acentric_settings* settings, int32_t texture_pixels) {
  const char* const wrong = isTextureSize(texture_pixels) ? nullptr : kTextureSize;
  return forView(bundle, view, settings, wrong, [&](BundlePlayer&, const Wanted& wanted) {
    LoadJob like;
    like.model = true, like.texturePixels = texture_pixels;
    const auto wants = [&](const LoadJob& job) {
      return !bundle->handedOut.contains(job) && !hasBetter(*bundle, job);
    };
    return request(*bundle, wanted, Loaded::full, wants, like);
  });
}

acentric_status acentric_next_model(acentric_bundle* bundle, acentric_arrival* arrival) {
  if (arrival != nullptr) *arrival = {};
  return guarded(bundle, [&](BundlePlayer&) {
    if (arrival == nullptr) return refused(bundle, "arrival is NULL");
    if (!bundle->loader) return kOk;
    std::optional<Arrival> next;
    do {
      next = bundle->loader->take([](const LoadJob& job) { return job.model; });
      if (!next) return kOk;
    } while (hasBetter(*bundle, next->job));
    const LoadJob& job = next->job;
    *arrival = {int32_t(job.storey), job.region ? ACENTRIC_REGION : ACENTRIC_CAPTURE, int32_t(job.number),
                job.region ? ACENTRIC_FULL : int32_t(job.detail), nullptr};
    if (!next->part) {
      bundle->failed.insert(job);
      return failed(*bundle, next->part.error());
    }
    arrival->model = handOut(std::move(std::get<DrawModel>(*next->part)));
    bundle->handedOut.insert(job);
    return kOk;
  });
}

acentric_status acentric_return_model(acentric_bundle* bundle, const acentric_arrival* arrival) {
  return guarded(bundle, [&](BundlePlayer&) {
    if (arrival == nullptr) return refused(bundle, "arrival is NULL");
    std::erase_if(bundle->handedOut, [&](const LoadJob& job) {
      return int32_t(job.storey) == arrival->storey && int32_t(job.number) == arrival->number &&
             job.region == (arrival->kind == ACENTRIC_REGION) &&
             (job.region || int32_t(job.detail) == arrival->detail);
    });
    return kOk;
  });
}

void acentric_clip_from_model(const acentric_view* view, const double origin[3], double near,
                              float matrix[16]) {
  if (view == nullptr || origin == nullptr || matrix == nullptr) return;
  const PerspectiveView from = viewOf(*view);
  const glm::dmat3 axes = from.viewFromWorld();  // right, down, ahead
  const glm::dvec3 start = axes * (glm::dvec3(origin[0], origin[1], origin[2]) - from.eye);
  const double focal = from.focalPixels();
  for (int column = 0; column < 4; ++column) {
    const glm::dvec3 along = column < 3 ? axes[column] : start;
    float* m = matrix + 4 * column;
    m[0] = float(along.x * 2 * focal / from.width), m[1] = float(-along.y * 2 * focal / from.height);
    m[2] = float(along.z - (column == 3 ? 2 * near : 0)), m[3] = float(along.z);
  }
}
