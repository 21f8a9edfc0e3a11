#pragma once

#include <vcg/complex/complex.h>

#include <filesystem>
#include <string>
#include <vector>

/// The mesh that vcglib reads and writes for the tool: in doubles, with every attribute that the
/// formats know.
namespace tracked_mcf {

class VcglibVertex;
class VcglibEdge;
class VcglibFace;

struct VcglibTypes
    : vcg::UsedTypes<vcg::Use<VcglibVertex>::AsVertexType, vcg::Use<VcglibEdge>::AsEdgeType,
                     vcg::Use<VcglibFace>::AsFaceType> {};

class VcglibVertex
    : public vcg::Vertex<VcglibTypes, vcg::vertex::Coord3d, vcg::vertex::Normal3d,
                         vcg::vertex::Color4b, vcg::vertex::Qualityd, vcg::vertex::TexCoord2f,
                         vcg::vertex::Radiusf, vcg::vertex::BitFlags> {};

class VcglibEdge : public vcg::Edge<VcglibTypes, vcg::edge::VertexRef, vcg::edge::BitFlags> {};

class VcglibFace
    : public vcg::Face<VcglibTypes, vcg::face::VertexRef, vcg::face::Normal3d, vcg::face::Color4b,
                       vcg::face::Qualityd, vcg::face::WedgeTexCoord2f, vcg::face::BitFlags> {};

class VcglibMesh : public vcg::tri::TriMesh<std::vector<VcglibVertex>, std::vector<VcglibFace>,
                                            std::vector<VcglibEdge>> {
public:
    /// vcglib leaves the attributes that its OBJ reader adds to whoever deletes the mesh.
    ~VcglibMesh() { ClearAttributes(); }

    /// Where material libraries are looked for: vcglib would look in the working directory.
    inline static std::filesystem::path material_folder;
};

}  // namespace tracked_mcf
