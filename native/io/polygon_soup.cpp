#include "io/polygon_soup.h"

#include "core/errors.h"

namespace koebe::io {

PolygonMesh to_mesh(const Soup& soup)
{
    std::size_t corners = 0;
    for (const std::vector<Index>& polygon : soup.polygons) corners += polygon.size();
    if (std::max({soup.points.size(), soup.polygons.size(), corners}) >= most_elements) refuse_size();
    PolygonMesh mesh;
    mesh.vertices.resize(static_cast<Eigen::Index>(soup.points.size()), 3);
    for (std::size_t v = 0; v < soup.points.size(); ++v)
        std::ranges::copy(soup.points[v], mesh.vertices.row(static_cast<Eigen::Index>(v)).begin());
    mesh.corners.reserve(corners);
    mesh.face_begin.reserve(soup.polygons.size() + 1);
    for (const std::vector<Index>& polygon : soup.polygons) {
        mesh.corners.insert(mesh.corners.end(), polygon.begin(), polygon.end());
        mesh.face_begin.push_back(static_cast<Index>(mesh.corners.size()));
    }
    return mesh;
}

void refuse_size() { throw InputError("the mesh is too large for 32-bit indices"); }

void refuse(const std::string& element, std::size_t number, const char* complaint)
{
    throw InputError(element + ' ' + std::to_string(number) + ' ' + complaint,
                     element == "vertex" ? ElementKind::vertices : ElementKind::faces, {static_cast<Index>(number)});
}

void require_count_fits(std::size_t count, const std::string& element, std::size_t bytes)
{
    if (count > bytes) throw InputError("the header's number of element " + element + " does not fit the file");
}

}  // namespace koebe::io
