#include "engine/bake/ray_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <new>

#include "engine/bake/alpha_cells.h"
#include "engine/bake/area_lights.h"
#include "engine/bake/embree_handles.h"
#include "engine/bake/flush_denormals.h"
#include "engine/bake/gathered_light.h"
#include "engine/bake/ray_log.h"
#include "engine/bake/surface.h"
#include "engine/scene/instances.h"
#include "engine/scene/material_rules.h"
#include "engine/scene/mesh_attributes.h"
#include "engine/scene/placed_mesh.h"

namespace acentric {
namespace {

/// Geometry masks: rays that look for occluders do not see what light passes through, without asking a
/// filter.
constexpr unsigned kSolidMask = 1;
constexpr unsigned kClearMask = 2;

/// What a filter needs to know about its mesh.
struct FilteredMesh {
  const Scene* scene = nullptr;
  const Mesh* mesh = nullptr;
  MaterialRules rules;
  DetailRules detail;
  std::shared_ptr<const AlphaCells> cuts;  ///< null: the texture has to be read everywhere
};

struct TransmittanceContext {
  RTCIntersectContext base;
  glm::vec3 passed{1};
};

struct FirstError {
  std::mutex mutex;
  RTCError code = RTC_ERROR_NONE;
  std::string message;
};

void rememberError(void* where, RTCError code, const char* message) {
  auto& first = *static_cast<FirstError*>(where);
  const std::lock_guard lock(first.mutex);
  if (first.code != RTC_ERROR_NONE) return;
  first.code = code;
  first.message = message == nullptr ? "no details" : message;
}

tl::unexpected<Error> embreeFailure(RTCError code, const std::string& message, const std::string& where) {
  if (code == RTC_ERROR_OUT_OF_MEMORY)
    return fail(ErrorKind::outOfSpace,
                "not enough memory to make the scene traceable; simplify it or close other programs", where);
  return fail(ErrorKind::internal,
              fmt::format("Embree refused the scene: {} (error {})", message, static_cast<int>(code)), where);
}

glm::vec2 hitBarycentric(const RTCFilterFunctionNArguments& args, unsigned i) {
  return {RTCHitN_u(args.hit, args.N, i), RTCHitN_v(args.hit, args.N, i)};
}

bool isCutOut(const FilteredMesh& filtered, const glm::vec4& baseColour) {
  return filtered.rules.masked &&
         baseColour.a < filtered.scene->materials[std::size_t(filtered.mesh->material)].alphaCutoff;
}

/// Share of light that passes a clear surface. Blending passes 1 - alpha of every channel, as when pictures
/// are composed; glass passes its tint less what it reflects at the mean angle.
glm::vec3 passedBy(const FilteredMesh& filtered, const glm::vec4& baseColour) {
  if (!filtered.rules.clear()) return glm::vec3(0);
  glm::vec3 passed(1);
  if (filtered.rules.blended) passed *= 1 - glm::clamp(baseColour.a, 0.0f, 1.0f);
  if (filtered.rules.transmissive) {
    constexpr float kUnreflected = 0.92f;
    const float transmission = filtered.scene->materials[std::size_t(filtered.mesh->material)].transmission;
    passed *= glm::clamp(transmission * kUnreflected * glm::vec3(baseColour), 0.0f, 1.0f);
  }
  return passed;
}

AlphaCells::Cut cutAt(const FilteredMesh& filtered, unsigned triangle, const glm::vec2& barycentric) {
  if (!filtered.cuts) return AlphaCells::Cut::readTexture;
  const Mesh& mesh = *filtered.mesh;
  const TextureUse& use = filtered.scene->materials[std::size_t(mesh.material)].baseColourTexture;
  const glm::vec2 uv = interpolate(coordinatesOf(mesh, use), mesh.triangles[triangle], barycentric);
  return filtered.cuts->at(use.transform * glm::vec3(uv, 1));
}

void cutOutFilter(const RTCFilterFunctionNArguments* args) {
  const auto& filtered = *static_cast<const FilteredMesh*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const unsigned triangle = RTCHitN_primID(args->hit, args->N, i);
    const glm::vec2 at = hitBarycentric(*args, i);
    const AlphaCells::Cut cut = cutAt(filtered, triangle, at);
    if (cut == AlphaCells::Cut::nowhere) continue;
    if (cut == AlphaCells::Cut::everywhere ||
        isCutOut(filtered, baseColourAt(*filtered.scene, *filtered.mesh, triangle, at, filtered.detail)))
      args->valid[i] = 0;
  }
}

/// Occlusion asks what passes, one ray at a time: see RayScene::transmittance and isOccluded.
void passFilter(const RTCFilterFunctionNArguments* args) {
  constexpr float kBlack = 1.0f / 4096;
  const auto& filtered = *static_cast<const FilteredMesh*>(args->geometryUserPtr);
  auto& context = *reinterpret_cast<TransmittanceContext*>(args->context);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const unsigned triangle = RTCHitN_primID(args->hit, args->N, i);
    const glm::vec2 at = hitBarycentric(*args, i);
    const AlphaCells::Cut cut = cutAt(filtered, triangle, at);
    if (cut == AlphaCells::Cut::everywhere) {
      args->valid[i] = 0;
      continue;
    }
    if (cut == AlphaCells::Cut::nowhere && !filtered.rules.clear()) {
      context.passed = glm::vec3(0);
      continue;
    }
    const glm::vec4 colour = baseColourAt(*filtered.scene, *filtered.mesh, triangle, at, filtered.detail);
    if (isCutOut(filtered, colour)) {
      args->valid[i] = 0;
      continue;
    }
    context.passed *= passedBy(filtered, colour);
    const bool dark = glm::all(glm::lessThan(context.passed, glm::vec3(kBlack)));
    if (!dark) args->valid[i] = 0;  // go on through it
  }
}

RTCRay embreeRay(const Ray& ray, unsigned mask) {
  RTCRay r{};
  r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
  r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
  r.tnear = ray.nearest;
  r.tfar = ray.farthest;
  r.mask = mask;
  return r;
}

RTCRayHit nearestHit(RTCScene scene, const Ray& ray, unsigned mask) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query{};
  query.ray = embreeRay(ray, mask);
  query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, &context, &query);
  return query;
}

/// By something that lets no light pass; what passes the rest is in the context.
bool isBlocked(RTCScene scene, const Ray& ray, unsigned mask, TransmittanceContext& context) {
  rtcInitIntersectContext(&context.base);
  RTCRay query = embreeRay(ray, mask);
  rtcOccluded1(scene, &context.base, &query);
  return query.tfar < 0;  // Embree marks an occluded ray by tfar = -infinity
}

/// Traces a packet; what its rays hit is in the result.
RTCRayHit8 traced(RTCScene scene, const RayPacket& rays, unsigned mask) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  alignas(32) int valid[RayPacket::kSize];
  RTCRayHit8 query{};
  for (int i = 0; i < RayPacket::kSize; ++i) {
    const auto n = std::size_t(i);
    valid[i] = i < rays.count ? -1 : 0;
    if (i >= rays.count) continue;
    query.ray.org_x[i] = rays.origin.x, query.ray.org_y[i] = rays.origin.y,
    query.ray.org_z[i] = rays.origin.z;
    query.ray.dir_x[i] = rays.direction[n].x, query.ray.dir_y[i] = rays.direction[n].y;
    query.ray.dir_z[i] = rays.direction[n].z;
    query.ray.tnear[i] = rays.nearest[n];
    query.ray.tfar[i] = std::numeric_limits<float>::infinity();
    query.ray.mask[i] = mask;
    query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  rtcIntersect8(valid, scene, &context, &query);
  return query;
}

int hitsAmong(const RTCRayHit8& query, int count) {
  return int(std::count_if(query.hit.geomID, query.hit.geomID + count,
                           [](unsigned geometry) { return geometry != RTC_INVALID_GEOMETRY_ID; }));
}

/// Embree reads 16 bytes at a time: of a mapped array in place, of a vector, whose end nothing follows, a
/// copy.
template <class T>
bool setBuffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, const MeshArray<T>& array) {
  if (array.isMapped()) {
    rtcSetSharedGeometryBuffer(geometry, type, 0, format, array.data(), 0, sizeof(T), array.size());
    return true;
  }
  void* own = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), array.size());
  if (own != nullptr) std::ranges::copy(array, static_cast<T*>(own));
  return own != nullptr;
}

Status checkMesh(const Scene& scene, const Mesh& mesh) {
  const auto bad = [&](const char* message) {
    return fail(ErrorKind::malformed, message, fmt::format("{}, mesh {}", scene.name, mesh.name));
  };
  if (mesh.material < 0 || std::size_t(mesh.material) >= scene.materials.size())
    return bad("its material does not exist");
  for (const auto& t : mesh.triangles)
    if (std::max(t.x, std::max(t.y, t.z)) >= mesh.positions.size())
      return bad("a triangle names a corner that does not exist");
  const auto fits = [&](std::size_t size) { return size == 0 || size == mesh.positions.size(); };
  if (!fits(mesh.normals.size()) || !fits(mesh.tangents.size()) || !fits(mesh.colours.size()) ||
      !fits(mesh.uv[0].size()) || !fits(mesh.uv[1].size()))
    return bad("its attributes differ in number from its positions");
  return {};
}

Status checkInstances(const Scene& scene) {
  for (const Mesh& prototype : scene.prototypes)
    if (auto sound = checkMesh(scene, prototype); !sound) return sound;
  for (const Instance& instance : scene.instances)
    if (instance.prototype >= scene.prototypes.size() || !isPlacement(instance.worldFromPrototype))
      return fail(ErrorKind::malformed, "an instance has no prototype, or a transform without an inverse",
                  scene.name);
  return {};
}

/// The placed mesh that was hit: instances have their own numbers, after the meshes'.
std::uint32_t placedHit(unsigned geometry, unsigned instance) {
  return instance == RTC_INVALID_GEOMETRY_ID ? geometry : instance;
}

}  // namespace

RayCounts& RayCounts::operator+=(const RayCounts& other) {
  primary += other.primary;
  visibility += other.visibility;
  shadow += other.shadow;
  softShadow += other.softShadow;
  ambient += other.ambient;
  bounce += other.bounce;
  mirror += other.mirror;
  through += other.through;
  gathered += other.gathered;
  gatherSeconds += other.gatherSeconds;
  return *this;
}

struct RayScene::Embree {
  FirstError error;
  EmbreeDevice device;
  EmbreeScene scene;
  std::vector<std::unique_ptr<FilteredMesh>> filtered;  ///< address handed to Embree

  std::vector<EmbreeScene> prototypes;  ///< by Scene::prototypes
  std::vector<std::shared_ptr<const AlphaCells>> cuts;

  Status open(const std::string& name);
  EmbreeScene newScene() const;
  /// As geometry `number` of `into`.
  Status add(RTCScene into, unsigned number, const Scene& source, const Mesh& mesh,
             const MaterialRules& rules, const DetailRules& detail);
  /// All prototypes, and an instance of them for each of the scene's.
  Status addInstances(const Scene& source, const std::vector<MaterialRules>& rules,
                      const DetailRules& detail);
  Status commit(const std::string& name);
  /// Null where alpha is not a texture's alone.
  std::shared_ptr<const AlphaCells> cutsOf(const Scene& source, const Mesh& mesh, const DetailRules& detail);
};

std::shared_ptr<const AlphaCells> RayScene::Embree::cutsOf(const Scene& source, const Mesh& mesh,
                                                           const DetailRules& detail) {
  const Material& material = source.materials[std::size_t(mesh.material)];
  const TextureSampler texture(source, material.baseColourTexture);
  const float factor = material.baseColour.a;
  if (!detail.textures || !hasCoordinates(mesh, material.baseColourTexture) || !texture.used() ||
      (detail.vertexColours && !mesh.colours.empty()) || !(factor >= 0))
    return nullptr;
  for (const auto& known : cuts)
    if (known->isOf(texture, factor, material.alphaCutoff)) return known;
  cuts.push_back(std::make_shared<const AlphaCells>(texture, factor, material.alphaCutoff));
  return cuts.back();
}

EmbreeScene RayScene::Embree::newScene() const {
  EmbreeScene made(rtcNewScene(device.get()));
  if (!made) return made;
  rtcSetSceneFlags(made.get(), RTC_SCENE_FLAG_ROBUST);
  // Not "high": its spatial splits may report one triangle twice, and a tint would count twice.
  rtcSetSceneBuildQuality(made.get(), RTC_BUILD_QUALITY_MEDIUM);
  return made;
}

Status RayScene::Embree::open(const std::string& name) {
  device = EmbreeDevice(rtcNewDevice("verbose=0"));
  if (!device) return embreeFailure(rtcGetDeviceError(nullptr), "no device on this machine", name);
  rtcSetDeviceErrorFunction(device.get(), rememberError, &error);
  if (rtcGetDeviceProperty(device.get(), RTC_DEVICE_PROPERTY_RAY_MASK_SUPPORTED) == 0 ||
      rtcGetDeviceProperty(device.get(), RTC_DEVICE_PROPERTY_FILTER_FUNCTION_SUPPORTED) == 0)
    return fail(ErrorKind::unsupported,
                "this Embree was built without ray masks or filter functions; install Debian's", name);
  scene = newScene();
  if (!scene) return embreeFailure(error.code, error.message, name);
  return {};
}

Status RayScene::Embree::add(RTCScene into, unsigned number, const Scene& source, const Mesh& mesh,
                             const MaterialRules& rules, const DetailRules& detail) {
  EmbreeGeometry geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  if (!geometry) return embreeFailure(error.code, error.message, source.name);
  const bool taken = setBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.positions) &&
                     setBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles);
  if (!taken) return embreeFailure(error.code, error.message, source.name);

  rtcSetGeometryMask(geometry.get(), rules.clear() ? kClearMask : kSolidMask);
  if (rules.masked || rules.clear()) {
    filtered.push_back(std::make_unique<FilteredMesh>(
        FilteredMesh{&source, &mesh, rules, detail, rules.masked ? cutsOf(source, mesh, detail) : nullptr}));
    rtcSetGeometryUserData(geometry.get(), filtered.back().get());
    if (rules.masked) rtcSetGeometryIntersectFilterFunction(geometry.get(), cutOutFilter);
    rtcSetGeometryOccludedFilterFunction(geometry.get(), passFilter);
  }
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(into, geometry.get(), number);
  return {};
}

Status RayScene::Embree::addInstances(const Scene& source, const std::vector<MaterialRules>& rules,
                                      const DetailRules& detail) {
  const auto rulesOf = [&](std::size_t prototype) -> const MaterialRules& {
    return rules[std::size_t(source.prototypes[prototype].material)];
  };
  for (std::size_t p = 0; p < source.prototypes.size(); ++p) {
    prototypes.push_back(newScene());
    if (!prototypes.back()) return embreeFailure(error.code, error.message, source.name);
    if (source.prototypes[p].triangles.empty()) continue;
    if (auto added = add(prototypes.back().get(), 0, source, source.prototypes[p], rulesOf(p), detail);
        !added)
      return added;
    rtcCommitScene(prototypes.back().get());
  }
  for (std::size_t i = 0; i < source.instances.size(); ++i) {
    const Instance& instance = source.instances[i];
    if (source.prototypes[instance.prototype].triangles.empty()) continue;
    EmbreeGeometry geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    if (!geometry) return embreeFailure(error.code, error.message, source.name);
    rtcSetGeometryInstancedScene(geometry.get(), prototypes[instance.prototype].get());
    rtcSetGeometryTimeStepCount(geometry.get(), 1);
    rtcSetGeometryTransform(geometry.get(), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR,
                            &instance.worldFromPrototype[0].x);
    rtcSetGeometryMask(geometry.get(), rulesOf(instance.prototype).clear() ? kClearMask : kSolidMask);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(scene.get(), geometry.get(), unsigned(source.meshes.size() + i));
  }
  return {};
}

Status RayScene::Embree::commit(const std::string& name) {
  rtcCommitScene(scene.get());
  if (error.code != RTC_ERROR_NONE) return embreeFailure(error.code, error.message, name);
  return {};
}

RayScene::RayScene(ScenePtr scene, const EffectPlan& plan)
    : scene_(std::move(scene)), plan_(plan), embree_(std::make_unique<Embree>()) {}

RayScene::~RayScene() = default;

Result<std::shared_ptr<const RayScene>> RayScene::build(ScenePtr scene, const EffectPlan& plan, RayLog* log) {
  const FlushDenormals flush;
  try {
    std::shared_ptr<RayScene> made(new RayScene(std::move(scene), plan));
    const Scene& source = *made->scene_;
    if (auto opened = made->embree_->open(source.name); !opened) return tl::unexpected(opened.error());
    const auto rules = materialRules(source, plan);
    const auto detail = detailRules(plan);
    for (std::uint32_t m = 0; m < source.meshes.size(); ++m) {
      const Mesh& mesh = source.meshes[m];
      if (auto sound = checkMesh(source, mesh); !sound) return tl::unexpected(sound.error());
      if (mesh.triangles.empty()) continue;
      if (auto added = made->embree_->add(made->embree_->scene.get(), m, source, mesh,
                                          rules[std::size_t(mesh.material)], detail);
          !added)
        return tl::unexpected(added.error());
    }
    if (auto sound = checkInstances(source); !sound) return tl::unexpected(sound.error());
    if (auto added = made->embree_->addInstances(source, rules, detail); !added)
      return tl::unexpected(added.error());
    if (auto committed = made->embree_->commit(source.name); !committed)
      return tl::unexpected(committed.error());
    made->log_ = log;
    made->areaLights_ = std::make_unique<const AreaLights>(source, plan);
    return made;
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::outOfSpace, "not enough memory to make the scene traceable");
  }
}

Hit RayScene::trace(const Ray& ray) const { return trace(ray, kSolidMask | kClearMask); }
Hit RayScene::traceSolid(const Ray& ray) const { return trace(ray, kSolidMask); }

void RayScene::note(const Ray& ray, unsigned mask, bool nearest) const {
  if (log_ != nullptr) log_->add(ray, mask, nearest ? RayLog::Asked::nearest : RayLog::Asked::passing);
}
void RayScene::note(const RayPacket& rays, unsigned mask) const {
  if (log_ != nullptr) log_->add(rays, mask);
}

std::uint64_t RayScene::replay(const RayLog& log) const {
  std::uint64_t hits = 0;
  for (const RayLog::Single& single : log.singles()) {
    if (single.asked == RayLog::Asked::nearest) {
      hits += nearestHit(embree_->scene.get(), single.ray, single.mask).hit.geomID != RTC_INVALID_GEOMETRY_ID;
      continue;
    }
    TransmittanceContext context;
    hits += isBlocked(embree_->scene.get(), single.ray, single.mask, context);
  }
  for (const auto& [rays, mask] : log.packets())
    hits += std::uint64_t(hitsAmong(traced(embree_->scene.get(), rays, mask), rays.count));
  return hits;
}

Hit RayScene::trace(const Ray& ray, unsigned mask) const {
  note(ray, mask, true);
  const RTCRayHit query = nearestHit(embree_->scene.get(), ray, mask);
  Hit hit;
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
  hit.distance = query.ray.tfar;
  hit.mesh = placedHit(query.hit.geomID, query.hit.instID[0]);
  hit.triangle = query.hit.primID;
  hit.barycentric = {query.hit.u, query.hit.v};
  hit.across = acrossOf(hit.mesh, {query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z});
  return hit;
}

/// Embree's normals are in the frame of what it traces.
glm::vec3 RayScene::acrossOf(std::uint32_t placed, const glm::vec3& across) const {
  if (!scene_->isInstance(placed)) return across;
  return glm::vec3(PlacedMesh(*scene_, placed).turned(glm::dvec3(across)));
}

void RayScene::trace(const RayPacket& rays, std::array<Hit, RayPacket::kSize>& hits) const {
  note(rays, kSolidMask | kClearMask);
  const RTCRayHit8 query = traced(embree_->scene.get(), rays, kSolidMask | kClearMask);
  for (int i = 0; i < rays.count; ++i) {
    Hit& hit = hits[std::size_t(i)];
    hit.distance = std::numeric_limits<float>::infinity();
    if (query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    hit.distance = query.ray.tfar[i];
    hit.mesh = placedHit(query.hit.geomID[i], query.hit.instID[0][i]);
    hit.triangle = query.hit.primID[i];
    hit.barycentric = {query.hit.u[i], query.hit.v[i]};
    hit.across = acrossOf(hit.mesh, {query.hit.Ng_x[i], query.hit.Ng_y[i], query.hit.Ng_z[i]});
  }
}

int RayScene::countHits(const RayPacket& rays) const {
  note(rays, kSolidMask | kClearMask);
  return hitsAmong(traced(embree_->scene.get(), rays, kSolidMask | kClearMask), rays.count);
}

void RayScene::occluderDistances(const RayPacket& rays,
                                 std::array<float, RayPacket::kSize>& distances) const {
  note(rays, kSolidMask);
  const RTCRayHit8 query = traced(embree_->scene.get(), rays, kSolidMask);
  for (int i = 0; i < rays.count; ++i)
    distances[std::size_t(i)] = query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID
                                    ? std::numeric_limits<float>::infinity()
                                    : query.ray.tfar[i];
}

glm::vec3 RayScene::transmittance(const Ray& ray) const {
  note(ray, kSolidMask | kClearMask, false);
  TransmittanceContext context;
  return isBlocked(embree_->scene.get(), ray, kSolidMask | kClearMask, context) ? glm::vec3(0)
                                                                                : context.passed;
}

float RayScene::occluderDistance(const Ray& ray) const {
  note(ray, kSolidMask, true);
  const RTCRayHit query = nearestHit(embree_->scene.get(), ray, kSolidMask);
  return query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<float>::infinity()
                                                     : query.ray.tfar;
}

bool RayScene::isOccluded(const Ray& ray) const {
  note(ray, kSolidMask, false);
  Ray before = ray;
  if (std::isfinite(ray.farthest)) before.farthest = std::nextafter(ray.farthest, 0.0f);
  TransmittanceContext context;
  return isBlocked(embree_->scene.get(), before, kSolidMask, context);
}

std::shared_ptr<const GatheredLight> RayScene::gatheredLight(const BakeSettings& settings) const {
  const std::lock_guard lock(gatheredMutex_);
  if (!gathered_ || gathered_->settings() != GatherSettings::of(settings))
    gathered_ = std::make_shared<const GatheredLight>(*this, settings);
  return gathered_;
}

}  // namespace acentric
