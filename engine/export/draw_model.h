#pragma once
/// Triangles with textures as any renderer draws them: with a depth test and without light. GLBs are written
/// from it (glb.h), and programs draw it themselves (acentric_runtime.h, acentric_model).

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "engine/image/image.h"
#include "engine/scene/scene.h"

namespace acentric {

struct DrawTexture {
  ColourImage image;
  bool nearest = false;
  Wrap wrapU = Wrap::clamp, wrapV = Wrap::clamp;
};

/// What is shown is factor * texture * colour of the vertex, of which colours are multiplied as they are
/// linear.
struct DrawMesh {
  std::string part;  ///< "captures", "near" or "sky"
  std::string material;
  std::vector<glm::vec3> positions;  ///< metres, Z up, relative to the model's origin
  std::vector<glm::vec2> uv;         ///< empty, or one each: (0, 0) is the texture's upper left corner
  std::vector<glm::vec3> colours;    ///< empty, or one each: display-linear, 0..1
  std::vector<glm::uvec3> triangles;
  int texture = -1;  ///< of the model
  glm::vec4 factor{1};
  AlphaMode alpha = AlphaMode::opaque;
  float cutoff = 0.5F;  ///< of AlphaMode::mask
  bool doubleSided = true;
  std::uint8_t roles = 0xff;  ///< of the camera, that draw it
};

struct DrawModel {
  glm::dvec3 origin{0};  ///< of positions
  std::vector<DrawTexture> textures;
  std::vector<DrawMesh> meshes;  ///< in the order in which blended ones are best drawn
};

}  // namespace acentric
