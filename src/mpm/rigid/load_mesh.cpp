// Mesh files through assimp.
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <filesystem>
#include <sstream>

#include "mpm/rigid/mesh_topology.hpp"

namespace mpm {

namespace {

Vec3 to_vec3(const aiVector3D& v) { return {v.x, v.y, v.z}; }

/// Adds the triangles of a node and of those below it, moved by the transforms on the way.
void collect(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent, double scale, TriangleMesh& result) {
  const aiMatrix4x4 transform = parent * node.mTransformation;
  const bool mirrored = transform.Determinant() < 0.0F;
  for (unsigned m = 0; m < node.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[m]];
    const int first = static_cast<int>(result.vertices.size());
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      result.vertices.push_back(scale * to_vec3(transform * mesh.mVertices[v]));
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;  // points and lines of a drawing
      const int a = first + static_cast<int>(face.mIndices[0]);
      const int b = first + static_cast<int>(face.mIndices[1]);
      const int c = first + static_cast<int>(face.mIndices[2]);
      result.triangles.push_back(mirrored ? std::array<int, 3>{a, c, b} : std::array<int, 3>{a, b, c});
    }
  }
  for (unsigned c = 0; c < node.mNumChildren; ++c) collect(scene, *node.mChildren[c], transform, scale, result);
}

}  // namespace

TriangleMesh load_mesh(const std::string& path, double scale) {
  if (!(scale > 0.0) || std::isinf(scale)) {
    std::ostringstream text;
    text << path << ": mesh scale is " << scale << "; it must be positive and finite";
    throw RigidError(text.str());
  }
  const std::string file = resolve_resource(path);
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) {
    throw RigidError(path + ": no such mesh file" + (file == path ? "" : " (" + file + ")"));
  }
  Assimp::Importer importer;
  // Axes as the file has them (z up in robotics), as RViz shows them; assimp would turn COLLADA's to y up.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  // Vertices are joined here, by equal coordinates: assimp's own joining looks at normals and colours too, and takes
  // vertices less than 1e-5 apart, in whatever unit the file has, for equal.
  const aiScene* scene = importer.ReadFile(file, aiProcess_Triangulate);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    std::string reason = importer.GetErrorString();
    for (char& c : reason) c = c == '\n' ? ' ' : c;
    throw RigidError(path + ": cannot be read as a mesh: " + (reason.empty() ? "it is empty" : reason));
  }
  TriangleMesh mesh;
  collect(*scene, *scene->mRootNode, aiMatrix4x4(), scale, mesh);
  if (mesh.triangles.empty()) throw RigidError(path + ": holds no triangles");
  try {
    return join_equal_vertices(mesh);
  } catch (const RigidError& error) {
    throw RigidError(path + ": " + error.what());
  }
}

}  // namespace mpm
