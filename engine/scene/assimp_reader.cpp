/// OBJ, PLY, STL, FBX, COLLADA and the rest through assimp. It crashes and hangs on some broken files; it
/// therefore only runs in the importer process.

#include <assimp/GltfMaterial.h>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/DefaultIOSystem.h>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <optional>

#include "engine/base/file.h"
#include "engine/scene/assimp_materials.h"
#include "engine/scene/instances.h"
#include "engine/scene/source_scene.h"

namespace acentric {
namespace {

/// Reads only what the model may name, and remembers it.
class RecordingFiles : public Assimp::DefaultIOSystem {
 public:
  RecordingFiles(References& references, ReportLines& ignored) : references_(references), ignored_(ignored) {}

  bool Exists(const char* file) const override {
    return references_.mayRead(file) && DefaultIOSystem::Exists(file);
  }

  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (std::string_view(mode).find_first_of("wa+") != std::string_view::npos) return nullptr;
    std::error_code error;
    if (!references_.mayRead(file)) {
      if (std::filesystem::exists(file, error))
        ignored_.add(fmt::format("file {}: {}", file, References::outside(file, {}).message));
      return nullptr;
    }
    if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error))
      return nullptr;
    references_.noteRead(file);
    return DefaultIOSystem::Open(file, mode);
  }

 private:
  References& references_;
  ReportLines& ignored_;
};

glm::dmat4 matrixOf(const aiMatrix4x4& m) {
  return glm::dmat4(m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2, m.a3, m.b3, m.c3, m.d3, m.a4, m.b4, m.c4,
                    m.d4);
}

glm::vec3 vectorOf(const aiVector3D& v) { return {v.x, v.y, v.z}; }

std::string lowerExtension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return extension;
}

/// COLLADA states unit and up axis in its head: <unit meter="0.01"/> and <up_axis>Z_UP</up_axis>.
void readColladaHead(const ReadContext& context, SourceScene& scene) {
  const auto text = readText(context.path);
  if (!text) return;
  scene.metresPerUnit = 1;
  scene.up = UpAxis::y;
  scene.unitSource = scene.upSource = "COLLADA";
  const std::string_view head = std::string_view(*text).substr(0, 65536);
  if (const auto unit = head.find("<unit"); unit != head.npos) {
    const auto meter = head.find("meter=\"", unit);
    if (meter != head.npos && meter < head.find('>', unit)) {
      const double value = std::strtod(std::string(head.substr(meter + 7, 32)).c_str(), nullptr);
      if (value > 0 && std::isfinite(value)) scene.metresPerUnit = value;
    }
  }
  if (const auto up = head.find("<up_axis>"); up != head.npos) {
    if (head.substr(up, 32).find("Z_UP") != head.npos) scene.up = UpAxis::z;
    if (head.substr(up, 32).find("X_UP") != head.npos) scene.ignored.add("X as up axis (Y is taken)");
  }
}

/// OBJ has no place for a unit, but programs that write it say theirs in the comments at the top: SketchUp
/// "# File units = inches"; the engine of Cube 2 (Sauerbraten, Red Eclipse) that the file is a level of it,
/// whose grid has eight units to the metre.
void readObjHead(const ReadContext& context, SourceScene& scene) {
  std::string head(4096, '\0');
  std::ifstream file(context.path, std::ios::binary);
  file.read(head.data(), std::streamsize(head.size()));
  head.resize(std::size_t(file.gcount()));
  if (head.find("# obj file of Cube 2 level") != head.npos) {
    scene.metresPerUnit = 0.125;
    scene.unitSource = "the file says that it is a level of Cube 2, which has 8 units to the metre";
    return;
  }
  constexpr std::string_view kUnits = "# File units = ";
  const auto at = head.find(kUnits);
  if (at == head.npos) return;
  const std::string_view unit = std::string_view(head).substr(at + kUnits.size(), 12);
  for (const auto& [name, metres] :
       {std::pair{"inches", 0.0254}, std::pair{"feet", 0.3048}, std::pair{"millimeters", 0.001},
        std::pair{"centimeters", 0.01}, std::pair{"meters", 1.0}})
    if (unit.starts_with(name)) scene.metresPerUnit = metres, scene.unitSource = "the file's comments";
}

void readMetadata(const aiScene& from, SourceScene& scene) {
  if (!from.mMetaData) return;
  double centimetres = 0;
  float single = 0;
  if (!from.mMetaData->Get("UnitScaleFactor", centimetres) && from.mMetaData->Get("UnitScaleFactor", single))
    centimetres = single;
  if (centimetres > 0 && std::isfinite(centimetres)) {
    scene.metresPerUnit = centimetres * 0.01;
    scene.unitSource = "the file's unit scale";
  }
  int up = 0;
  if (from.mMetaData->Get("UpAxis", up) && (up == 1 || up == 2)) {
    scene.up = up == 1 ? UpAxis::y : UpAxis::z;
    scene.upSource = "the file";
  }
}

class AssimpReader {
 public:
  /// `rootScale` undoes what assimp has already done to the root.
  AssimpReader(const aiScene& from, const ReadContext& context, double rootScale, SourceScene& scene)
      : from_(from), scene_(scene), rootScale_(rootScale), materials_(from, context, scene) {}

  Status read() {
    if (!from_.mRootNode) return fail(ErrorKind::malformed, "has no root node");
    if (auto status = walk(); !status) return status;
    readLights();
    if (from_.mNumAnimations > 0)
      scene_.ignored.add(counted(from_.mNumAnimations, "animation", "animations"));
    if (from_.mNumCameras > 0) scene_.ignored.add(counted(from_.mNumCameras, "camera", "cameras"));
    return {};
  }

 private:
  /// How many times each mesh is shown.
  std::vector<std::uint32_t> usesOf() const {
    std::vector<std::uint32_t> uses(from_.mNumMeshes, 0);
    std::vector<const aiNode*> stack{from_.mRootNode};
    while (!stack.empty()) {
      const aiNode* node = stack.back();
      stack.pop_back();
      for (unsigned i = 0; i < node->mNumMeshes; ++i)
        if (node->mMeshes[i] < uses.size()) ++uses[node->mMeshes[i]];
      for (unsigned i = 0; i < node->mNumChildren; ++i) stack.push_back(node->mChildren[i]);
    }
    return uses;
  }

  Status walk() {
    const std::vector<std::uint32_t> uses = usesOf();
    prototypes_.resize(uses.size());
    for (std::size_t m = 0; m < uses.size(); ++m) shared_.push_back(uses[m] > 1);
    std::vector<std::pair<const aiNode*, glm::dmat4>> stack{
        {from_.mRootNode, glm::scale(glm::dmat4(1), glm::dvec3(rootScale_))}};
    while (!stack.empty()) {
      const auto [node, parent] = stack.back();
      stack.pop_back();
      const glm::dmat4 world = parent * matrixOf(node->mTransformation);
      nodes_.emplace(node->mName.C_Str(), world);
      for (unsigned i = 0; i < node->mNumMeshes; ++i) {
        if (node->mMeshes[i] >= from_.mNumMeshes)
          return fail(ErrorKind::malformed, "names a mesh that does not exist");
        if (auto status = readMesh(node->mMeshes[i], node->mName.C_Str(), world); !status) return status;
      }
      for (unsigned i = node->mNumChildren; i-- > 0;) stack.emplace_back(node->mChildren[i], world);
    }
    return {};
  }

  Status readMesh(unsigned number, const char* nodeName, const glm::dmat4& world) {
    const aiMesh& mesh = *from_.mMeshes[number];
    if (!shared_[number]) {
      auto read = triangles(mesh, nodeName);
      if (!read) return tl::unexpected(read.error());
      if (read->triangles.empty()) return {};
      applyTransform(*read, world);
      scene_.meshes.push_back(std::move(*read));
      return {};
    }
    if (!prototypes_[number]) {
      auto read = triangles(mesh, nodeName);
      if (!read) return tl::unexpected(read.error());
      prototypes_[number] = std::uint32_t(scene_.prototypes.size());
      scene_.prototypes.push_back(std::move(*read));
    }
    const SourceMesh& prototype = scene_.prototypes[*prototypes_[number]];
    if (prototype.triangles.empty()) return {};
    if (scene_.instances.size() >= kMaxInstances)
      return fail(ErrorKind::tooLarge,
                  fmt::format("has more than {} instances; make one mesh of those that stand together",
                              kMaxInstances));
    scene_.instances.push_back({*prototypes_[number], std::uint32_t(scene_.meshes.size()),
                                mesh.mName.length > 0 ? mesh.mName.C_Str() : nodeName, world});
    return {};
  }

  /// In the mesh's frame; none where it has none.
  Result<SourceMesh> triangles(const aiMesh& mesh, const char* nodeName) {
    if (mesh.mPrimitiveTypes & aiPrimitiveType_POINT) scene_.ignored.add("points");
    if (mesh.mPrimitiveTypes & aiPrimitiveType_LINE) scene_.ignored.add("lines");
    if (mesh.mNumBones > 0) scene_.ignored.add("skins (the meshes stand as modelled)");
    scene_.indexCount += 3 * std::size_t(mesh.mNumFaces);
    if (scene_.indexCount > kMaxSceneIndices)
      return fail(ErrorKind::tooLarge, "has more than 2^31 indices; split it");
    SourceMesh out;
    out.name = mesh.mName.length > 0 ? mesh.mName.C_Str() : nodeName;
    out.triangles.reserve(mesh.mNumFaces);
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices == 3)
        out.triangles.emplace_back(face.mIndices[0], face.mIndices[1], face.mIndices[2]);
    }
    if (out.triangles.empty()) return out;
    const AssimpMaterial material = materials_.take(mesh.mMaterialIndex);
    out.material = material.index;
    readCorners(mesh, material, out);
    return out;
  }

  void readCorners(const aiMesh& mesh, const AssimpMaterial& material, SourceMesh& out) {
    const std::size_t count = mesh.mNumVertices;
    out.positions.resize(count);
    for (std::size_t i = 0; i < count; ++i)
      out.positions[i] = glm::dvec3(mesh.mVertices[i].x, mesh.mVertices[i].y, mesh.mVertices[i].z);
    if (mesh.mNormals) {
      out.normals.resize(count);
      for (std::size_t i = 0; i < count; ++i) out.normals[i] = vectorOf(mesh.mNormals[i]);
    }
    for (int slot = 0; slot < 2; ++slot) {
      const int set = material.uvSet[slot];
      if (set < 0) continue;
      out.uv[slot].assign(count, glm::vec2(0));
      if (set >= AI_MAX_NUMBER_OF_TEXTURECOORDS || !mesh.mTextureCoords[set]) {
        scene_.ignored.add(fmt::format("textures of mesh {}: it has no texture coordinates", out.name));
        continue;
      }
      for (std::size_t i = 0; i < count; ++i)
        out.uv[slot][i] = glm::vec2(vectorOf(mesh.mTextureCoords[set][i]));
    }
    if (mesh.mColors[0]) {
      scene_.guessed.add("vertex colours: taken as sRGB (the format does not say)");
      out.colours.resize(count);
      const auto code = [](float v) {
        return std::uint8_t(std::lround(255 * (v > 0 ? std::min(v, 1.0f) : 0.0f)));
      };
      for (std::size_t i = 0; i < count; ++i) {
        const aiColor4D& c = mesh.mColors[0][i];
        out.colours[i] = {code(linearOf(c.r)), code(linearOf(c.g)), code(linearOf(c.b)), code(c.a)};
      }
    }
  }

  void readLights() {
    for (unsigned i = 0; i < from_.mNumLights; ++i) {
      const aiLight& source = *from_.mLights[i];
      SourceLight out;
      if (source.mType == aiLightSource_DIRECTIONAL)
        out.light.kind = LightKind::directional;
      else if (source.mType == aiLightSource_POINT)
        out.light.kind = LightKind::point;
      else if (source.mType == aiLightSource_SPOT)
        out.light.kind = LightKind::spot;
      else {
        scene_.ignored.add(
            fmt::format("light {}: neither directional, point nor spot", source.mName.C_Str()));
        continue;
      }
      const glm::vec3 colour(source.mColorDiffuse.r, source.mColorDiffuse.g, source.mColorDiffuse.b);
      const float strongest = std::max({colour.r, colour.g, colour.b});
      if (!(strongest > 0) || !std::isfinite(strongest)) continue;
      out.light.name = source.mName.C_Str();
      out.light.colour = glm::max(colour / strongest, glm::vec3(0));
      out.light.intensity = strongest;
      if (out.light.kind != LightKind::directional) {
        const float quadratic = source.mAttenuationQuadratic;
        if (quadratic > 0 && std::isfinite(quadratic))
          out.light.intensity /= quadratic;
        else
          scene_.guessed.add(fmt::format(
              "light {}: falls off with the square of the distance (the file does not say)", out.light.name));
      }
      out.light.outerCone = glm::clamp(0.5f * source.mAngleOuterCone, 1e-3f, 1.570796f);
      out.light.innerCone = glm::clamp(0.5f * source.mAngleInnerCone, 0.0f, out.light.outerCone);
      const auto node = nodes_.find(source.mName.C_Str());
      const glm::dmat4 world = node == nodes_.end() ? glm::dmat4(1) : node->second;
      out.position = glm::dvec3(world * glm::dvec4(glm::dvec3(vectorOf(source.mPosition)), 1));
      glm::dvec3 direction = glm::dmat3(world) * glm::dvec3(vectorOf(source.mDirection));
      const double length = glm::length(direction);
      if (!(length > 0)) direction = {0, -1, 0};
      out.light.direction = glm::vec3(glm::normalize(direction));
      if (!std::isfinite(glm::dot(direction, direction) + glm::dot(out.position, out.position))) continue;
      scene_.lights.push_back(std::move(out));
    }
  }

  const aiScene& from_;
  SourceScene& scene_;
  double rootScale_;
  AssimpMaterials materials_;
  std::map<std::string, glm::dmat4> nodes_;
  std::vector<char> shared_;                              ///< by mesh: is it shown more than once?
  std::vector<std::optional<std::uint32_t>> prototypes_;  ///< by mesh, once it was read
};

}  // namespace

Result<SourceScene> readWithAssimp(const ReadContext& context) {
  SourceScene scene;
  const std::string extension = lowerExtension(context.path);
  Assimp::Importer importer;
  if (!importer.IsExtensionSupported(extension))
    return fail(ErrorKind::unsupported,
                fmt::format("has the extension '{}', which is not a model format that is read", extension));
  importer.SetIOHandler(new RecordingFiles(context.references, scene.ignored));  // the importer owns it
  // The up axis is ours to apply, so that the options can override it.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  double rootScale = 1;
  if (extension == ".dae") {
    readColladaHead(context, scene);
    rootScale = 1 / scene.metresPerUnit;  // assimp scales COLLADA to metres and has no switch for it
  }

  if (extension == ".obj") readObjHead(context, scene);

  context.tell(0, 0, "reading the file");
  const aiScene* from = importer.ReadFile(
      context.path.string(), aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_SortByPType |
                                 aiProcess_TransformUVCoords | aiProcess_FlipUVs);
  if (!from) {
    std::string why = importer.GetErrorString();
    std::replace(why.begin(), why.end(), '\n', ' ');
    if (why.find("bad_alloc") != why.npos)
      return fail(ErrorKind::outOfSpace, "needs more memory than there is");
    return fail(ErrorKind::malformed,
                why.empty() ? "cannot be read" : "cannot be read: " + why.substr(0, 300));
  }
  readMetadata(*from, scene);
  if (auto status = AssimpReader(*from, context, rootScale, scene).read(); !status)
    return tl::unexpected(status.error());
  return scene;
}

}  // namespace acentric
