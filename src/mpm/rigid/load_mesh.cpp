// Mesh files through assimp.
#include <assimp/DefaultIOSystem.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <filesystem>

#include "mpm/math/input_file.hpp"
#include "mpm/rigid/mesh_topology.hpp"
#include "xml_outline.hpp"

namespace mpm {

namespace {

constexpr int kDeepestNode = 200;  ///< nodes in each other, elements of XML, brackets of JSON
constexpr std::size_t kMostMeshBytes = std::size_t{1} << 29;  ///< bytes of a file

/// Opens regular files alone, also those that a mesh file names, such as the materials of an OBJ.
class RegularFiles final : public Assimp::DefaultIOSystem {
 public:
  bool Exists(const char* name) const override { return refused_input(name).empty(); }
  Assimp::IOStream* Open(const char* name, const char* mode) override {
    return Exists(name) ? DefaultIOSystem::Open(name, mode) : nullptr;
  }
};

Vec3 to_vec3(const aiVector3D& v) { return {v.x, v.y, v.z}; }

/// Adds the triangles of a node and of those below it, moved by the transforms on the way.
void collect(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent, double scale, int depth,
             TriangleMesh& result) {
  if (depth > kDeepestNode)
    throw RigidError(fmt::format("its nodes lie in each other more than {} deep", kDeepestNode));
  const aiMatrix4x4 transform = parent * node.mTransformation;
  const bool mirrored = transform.Determinant() < 0.0F;
  for (unsigned m = 0; m < node.mNumMeshes; ++m) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[m]];
    check_triangle_count(result.triangles.size() + mesh.mNumFaces);
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
  for (unsigned c = 0; c < node.mNumChildren; ++c)
    collect(scene, *node.mChildren[c], transform, scale, depth + 1, result);
}

/// Refuses what cannot be a mesh, or what assimp, which calls itself for every node, would not survive.
void check_file(const std::string& file) {
  if (const std::string refused = refused_input(file); !refused.empty()) throw RigidError(refused);
  std::error_code ignored;
  const std::uintmax_t bytes = std::filesystem::file_size(file, ignored);
  if (bytes > kMostMeshBytes) {
    throw RigidError(
        fmt::format("it has {} MB, and a mesh file {} MB at most; write it in a binary format, or with "
                    "fewer triangles",
                    bytes >> 20, kMostMeshBytes >> 20));
  }
  std::ifstream stream;
  if (const std::string refused = open_input(stream, file); !refused.empty()) throw RigidError(refused);
  char start = ' ';
  while (stream.get(start) && (start <= ' ' || (start & 0x80) != 0)) continue;  // blanks, and a byte order mark
  if (start != '<' && start != '{') return;
  std::string text;
  if (const std::string refused = read_input(file, text); !refused.empty()) throw RigidError(refused);
  (start == '<' ? check_depth_of_xml : check_depth_of_json)(text, kDeepestNode);
}

TriangleMesh read_mesh(const std::string& file, double scale) {
  check_file(file);
  Assimp::Importer importer;
  importer.SetIOHandler(new RegularFiles);  // handler that the importer deletes
  // Axes as the file has them (z up in robotics), as RViz shows them; assimp would turn COLLADA's to y up.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  // Vertices are joined here, by equal coordinates: assimp's own joining looks at normals and colours too, and takes
  // vertices less than 1e-5 apart, in whatever unit the file has, for equal.
  const aiScene* scene = importer.ReadFile(file, aiProcess_Triangulate);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    std::string reason = importer.GetErrorString();
    for (char& c : reason) c = c == '\n' ? ' ' : c;
    throw RigidError("cannot be read as a mesh: " + (reason.empty() ? "it is empty" : reason));
  }
  TriangleMesh mesh;
  collect(*scene, *scene->mRootNode, aiMatrix4x4(), scale, 0, mesh);
  if (mesh.triangles.empty()) throw RigidError("holds no triangles");
  return join_equal_vertices(mesh);
}

}  // namespace

TriangleMesh load_mesh(const std::string& path, double scale) {
  if (!(scale > 0.0) || std::isinf(scale))
    throw RigidError(fmt::format("{}: mesh scale is {:g}; it must be positive and finite", path, scale));
  const std::string file = resolve_resource(path);
  try {
    return read_mesh(file, scale);
  } catch (const RigidError& error) {
    throw RigidError(fmt::format("{}: {}{}", path, error.what(), file == path ? "" : " (" + file + ")"));
  }
}

}  // namespace mpm
