#pragma once
/// A glTF or GLB file into tinygltf's model: JSON and versions checked first, every file that it names
/// fetched by the rules of references.h, pictures kept as bytes. What the numbers in it mean is checked
/// later. Private to this folder.

#include "engine/scene/source_scene.h"

namespace tinygltf {
class Model;
}

namespace acentric {

Status loadGltf(const ReadContext& context, tinygltf::Model& model, ReportLines& ignored);

}  // namespace acentric
