#pragma once
/// What a reader (glTF, assimp) takes out of a file, before checks: triangles in world coordinates of the
/// file, in its axes and units, in double. finishScene (finish_scene.h) turns it into a Scene. Private to
/// this folder.

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "engine/scene/import.h"
#include "engine/scene/references.h"
#include "engine/scene/scene.h"

namespace acentric {

/// Limit on indices of a whole scene: 2^31.
inline constexpr std::size_t kMaxSceneIndices = std::size_t(1) << 31;

struct SourceMesh {
  std::string name;
  int material = 0;
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;  ///< these are empty or as long as positions
  std::vector<glm::vec4> tangents;
  std::vector<glm::vec2> uv[2];
  std::vector<glm::u8vec4> colours;
  std::vector<glm::uvec3> triangles;  ///< indices not checked yet
};

/// A prototype once more, in file order among the meshes.
struct SourceInstance {
  std::uint32_t prototype = 0;  ///< index into SourceScene::prototypes
  std::uint32_t before = 0;     ///< how many of SourceScene::meshes come before it
  std::string name;
  glm::dmat4 worldFromMesh{1};
};

struct SourceLight {
  Light light;  ///< direction and range in the file's axes and units; position is unused
  glm::dvec3 position{0};
};

/// "1,021,813 meshes", "1 mesh".
std::string counted(std::size_t count, const char* one, const char* many);

/// Lines for the report, each once, and no more of a kind than a person reads.
class ReportLines {
 public:
  void add(std::string line);
  std::vector<std::string> take();

 private:
  std::set<std::string> seen_;
  std::vector<std::string> lines_;
  std::size_t leftOut_ = 0;
};

struct SourceScene {
  std::vector<SourceMesh> meshes;
  std::vector<SourceMesh> prototypes;  ///< in frames of their own
  std::vector<SourceInstance> instances;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<std::shared_ptr<const ColourImage>> images;
  std::vector<SourceLight> lights;

  double metresPerUnit = 0;   ///< what the file says; 0 = nothing
  std::string unitSource;     ///< "glTF", "FBX file"
  UpAxis up = UpAxis::guess;  ///< what the file says
  std::string upSource;
  ReportLines ignored;
  ReportLines guessed;

  std::size_t indexCount = 0;  ///< of meshes and prototypes so far, against kMaxSceneIndices
};

/// What every reader is handed.
struct ReadContext {
  std::filesystem::path path;
  References& references;
  const Progress& progress;
  std::uint64_t memoryBytes = 0;  ///< that the scene may take; 0: as many as it likes

  void tell(double done, double total, const char* stage) const {
    if (progress) progress({done, total, stage});
  }
};

/// Refuses so many triangles, those of prototypes counted once, if a project of them would take more memory
/// than it may: before anything of their size is read.
Status checkRoom(std::uint64_t triangles, std::uint64_t memoryBytes);

/// Places a mesh: positions, normals and tangents; a mirroring transform turns the winding round.
void applyTransform(SourceMesh& mesh, const glm::dmat4& worldFromMesh);

/// Places the prototypes that need not stay apart as meshes: all of them where that gives no more triangles
/// than options.flatTriangles, else those with the fewest in all, and what mirrors or glows, which is looked
/// for triangle by triangle; then also places whose transform has no inverse. In file order.
Status placeInstances(SourceScene& scene, const ImportOptions& options);

/// A colour image from bytes that may be broken; nothing, with a line in `ignored`, if it is.
std::shared_ptr<const ColourImage> decodeOrIgnore(std::span<const std::byte> bytes, const std::string& name,
                                                  ReportLines& ignored);

Result<SourceScene> readGltf(const ReadContext& context);
Result<SourceScene> readWithAssimp(const ReadContext& context);

}  // namespace acentric
