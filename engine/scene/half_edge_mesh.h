#pragma once
/// The half-edge mesh that is decimated, by OpenMesh.

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace acentric {

struct HalfEdgeTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
  VertexTraits {
    std::uint32_t input = 0;  ///< vertex of the input
  };
  FaceTraits {
    std::uint32_t input = 0;  ///< triangle of the input
    std::vector<std::uint32_t>
        stoodHere;  ///< vertices of the input that were taken away and lie nearest to it
  };
};
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<HalfEdgeTraits>;
using Vertex = HalfEdgeMesh::VertexHandle;

inline glm::dvec3 toGlm(const OpenMesh::Vec3d& v) { return {v[0], v[1], v[2]}; }

}  // namespace acentric
