#include <cstddef>

#include "engine/capi/handle.h"

using namespace acentric;
using namespace acentric::capi;

namespace {

constexpr acentric_status kOk = ACENTRIC_OK;

// What is given out lies in memory as the header says.
static_assert(sizeof(acentric_sample) == sizeof(PackedSample) && offsetof(acentric_sample, row) == 4 &&
              sizeof(acentric_sample::row) == 4);
static_assert(sizeof(acentric_local_vertex) == sizeof(LocalVertex) &&
              sizeof(acentric_local_triangle) == sizeof(LocalTriangle));
static_assert(sizeof(glm::vec3) == 12 && sizeof(glm::vec2) == 8 && sizeof(HalfColour) == 8);
static_assert(int(Wrap::repeat) == ACENTRIC_REPEAT && int(Wrap::clamp) == ACENTRIC_CLAMP &&
              int(Wrap::mirror) == ACENTRIC_MIRROR);
static_assert(int(AlphaMode::opaque) == ACENTRIC_OPAQUE && int(AlphaMode::mask) == ACENTRIC_MASK &&
              int(AlphaMode::blend) == ACENTRIC_BLEND);

template <class To, class Vector>
const To* dataOf(const Vector& values) {
  return values.empty() ? nullptr : reinterpret_cast<const To*>(values.data());
}

acentric_samples samplesOf(const DisplayCapture& capture) {
  return {capture.samples.size(), capture.columnStart.data(), dataOf<acentric_sample>(capture.samples),
          dataOf<uint8_t>(capture.colour), dataOf<uint8_t>(capture.mirror)};
}

/// A region that is loaded; else an error.
template <class Body>
acentric_status forLoaded(acentric_bundle* bundle, int32_t storey, int32_t region, const void* out,
                          const Body& body) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    if (out == nullptr || !hasRegion(runtime, storey, region)) return refused(bundle, "no such region");
    const LocalGeometry* local = runtime.region(std::size_t(storey), std::size_t(region));
    if (local == nullptr) return failed(*bundle, ACENTRIC_ERROR_NOT_LOADED, "the region is not loaded");
    return body(*local);
  });
}

acentric_texture_use useOf(const TextureUse& use) {
  acentric_texture_use out{use.used() ? use.texture : -1, use.uvSet, {}};
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 3; ++column) out.rows[row][column] = use.transform[column][row];
  return out;
}

template <class Item>
bool has(const std::vector<Item>& items, int32_t number, const void* out) {
  return out != nullptr && within(number, items.size());
}

}  // namespace

acentric_status acentric_get_capture_data(acentric_bundle* bundle, int32_t storey, int32_t camera,
                                          int32_t detail, acentric_capture_data* out) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    if (out == nullptr || !hasCamera(runtime, storey, camera) ||
        (detail != ACENTRIC_COARSE && detail != ACENTRIC_FULL))
      return refused(bundle, "no such capture");
    const DisplayCapture* from = runtime.capture(std::size_t(storey), std::size_t(camera), Loaded(detail));
    if (from == nullptr) return failed(*bundle, ACENTRIC_ERROR_NOT_LOADED, "the capture is not loaded");
    *out = {};
    for (int i = 0; i < 3; ++i) out->centre[i] = from->camera.centreOfProjection[i];
    out->columns = from->camera.columns, out->rows = from->camera.rows;
    out->column_direction = dataOf<float>(from->columnDirection);
    out->row_tangent = from->rowTangent.data();
    out->surfaces = samplesOf(*from);
    if (from->reflections) out->reflections = samplesOf(*from->reflections);
    const CaptureBackground& runs = from->background.runs;
    out->runs = runs.runCount();
    out->run_start = dataOf<uint32_t>(runs.columnStart);
    out->run_first = dataOf<uint16_t>(runs.firstRow), out->run_end = dataOf<uint16_t>(runs.endRow);
    out->run_roles = dataOf<uint8_t>(runs.roles);
    return kOk;
  });
}

acentric_status acentric_get_region_data(acentric_bundle* bundle, int32_t storey, int32_t region,
                                         acentric_region_data* out) {
  return forLoaded(bundle, storey, region, out, [&](const LocalGeometry& local) {
    *out = {local.vertices.size(), local.triangles.size(), dataOf<acentric_local_vertex>(local.vertices),
            dataOf<acentric_local_triangle>(local.triangles), int32_t(local.surfaces->meshes.size())};
    return kOk;
  });
}

acentric_status acentric_get_mesh_data(acentric_bundle* bundle, int32_t storey, int32_t region, int32_t mesh,
                                       acentric_mesh_data* out) {
  return forLoaded(bundle, storey, region, out, [&](const LocalGeometry& local) {
    const LocalSurfaces& surfaces = *local.surfaces;
    if (!within(mesh, surfaces.meshes.size())) return refused(bundle, "no such mesh");
    const std::size_t number = std::size_t(mesh);
    const Mesh& from = surfaces.meshes[number];
    *out = {};
    out->material = from.material;
    out->vertex_count = from.positions.size(), out->triangle_count = from.triangles.size();
    out->positions = dataOf<float>(from.positions), out->normals = dataOf<float>(from.normals);
    out->uv0 = dataOf<float>(from.uv[0]), out->uv1 = dataOf<float>(from.uv[1]);
    out->colours = dataOf<uint8_t>(from.colours);
    out->triangles = dataOf<uint32_t>(from.triangles);
    if (!surfaces.mirrorPlanes.empty()) out->mirror_plane = dataOf<uint8_t>(surfaces.mirrorPlanes[number]);
    if (surfaces.light.empty()) return kOk;
    std::size_t first = 0;
    for (std::size_t m = 0; m < number; ++m) first += surfaces.meshes[m].triangles.size();
    out->first_sample = surfaces.light.firstSample.data() + first;
    out->resolution = surfaces.light.resolution.data() + first;
    out->has_back = surfaces.light.hasBack.data() + first;
    out->light = dataOf<uint16_t>(surfaces.light.light);
    return kOk;
  });
}

acentric_status acentric_get_texture(acentric_bundle* bundle, int32_t texture, acentric_texture* out) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    if (!has(runtime.bundle().textures, texture, out)) return refused(bundle, "no such texture");
    const BundleTexture& from = runtime.bundle().textures[std::size_t(texture)];
    const ColourImage* image = runtime.texture(std::size_t(texture));
    *out = {from.width,          from.height,  int32_t(from.wrapU),
            int32_t(from.wrapV), from.nearest, image != nullptr ? dataOf<uint8_t>(image->pixels) : nullptr};
    return kOk;
  });
}

acentric_status acentric_get_material(acentric_bundle* bundle, int32_t material, acentric_material* out) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    if (!has(runtime.bundle().materials, material, out)) return refused(bundle, "no such material");
    const Material& from = runtime.bundle().materials[std::size_t(material)];
    *out = {};
    out->name = from.name.c_str();
    for (int i = 0; i < 4; ++i) out->base_colour[i] = from.baseColour[i];
    for (int i = 0; i < 3; ++i) out->emissive[i] = from.emissive[i];
    out->base_colour_texture = useOf(from.baseColourTexture);
    out->emissive_texture = useOf(from.emissiveTexture);
    out->metallic = from.metallic, out->roughness = from.roughness;
    out->transmission = from.transmission, out->alpha_cutoff = from.alphaCutoff;
    out->alpha_mode = int32_t(from.alphaMode), out->double_sided = from.doubleSided, out->unlit = from.unlit;
    return kOk;
  });
}

acentric_status acentric_get_mirror(acentric_bundle* bundle, int32_t plane, acentric_mirror* out) {
  return guarded(bundle, [&](BundlePlayer& runtime) {
    if (!has(runtime.bundle().mirrors, plane, out)) return refused(bundle, "no such mirror");
    const MirrorPlane& from = runtime.bundle().mirrors[std::size_t(plane)];
    for (int i = 0; i < 3; ++i) out->normal[i] = from.normal[i], out->point[i] = from.point[i];
    return kOk;
  });
}
