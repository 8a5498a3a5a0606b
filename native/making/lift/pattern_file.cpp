#include "lift/pattern_file.h"

#include "files/extension.h"
#include "files/file_bytes.h"
#include "io/mesh_reader.h"
#include "lift/patterns.h"

namespace koebe {
namespace {

/// @param kind the extension of the pattern's file; empty for a built-in one
void require_fitting_options(const std::string& kind, const LiftOptions& options)
{
    const bool placed = kind == ".svg" || kind == ".obj";
    // Holes or a relief: a mesh is neither.
    if (kind != ".obj" && options.perforate == options.height.has_value())
        throw InputError("either perforate, or give a height");
    // What a file of its kind cannot have.
    if (options.turn != 0.0 && kind == ".png") throw InputError("an image has no turn");
    if (options.bridge && (kind == ".png" || kind == ".obj"))
        throw InputError("a bridge is for outlines: an image and a mesh have none");
    if (options.bridge && kind == ".svg" && !options.perforate && options.rim != LiftRim::whole)
        throw InputError("a drawing has its own bridges: they are checked where it is cut out");
    if (!options.graded.empty() && !kind.empty())
        throw InputError("graded sizes are for the built-in patterns: a file has its own");
    if (options.rim != LiftRim::leave && (kind == ".png" || kind == ".obj"))
        throw InputError("the rim cuts outlines: an image and a mesh have none");
    if (options.rim == LiftRim::clip && options.shape == LiftShape::sphere)
        throw InputError("on a sphere nothing is clipped: take --rim leave, or whole");
    if (kind == ".obj" && (options.perforate || options.thickness))
        throw InputError("a mesh is bent as it is: without perforate and thickness");
    if (options.even && options.shape == LiftShape::sphere)
        throw InputError("the map to the sphere has no evenness: leave it out");
    // Around a hole.
    const bool on_sphere = options.shape == LiftShape::sphere;
    if (options.around >= 0 && !(on_sphere ? placed : kind.empty() && options.shape == LiftShape::disk))
        throw InputError("around is for built-in patterns on a disk, and for drawings and meshes on a sphere");
    if (options.rows > 0 && (options.around < 0 || on_sphere)) throw InputError("rows are counted around a hole only");
    // An image.
    if (kind != ".png") return;
    if (!options.height) throw InputError("an image is a relief: give the height of white");
    if (options.shape == LiftShape::parts)
        throw InputError("an image is for disks, rings, tori and spheres: parts have cuts");
    if (options.repeats > 1 && options.shape == LiftShape::disk)
        throw InputError("repeats of an image are for rings, tori and spheres: a disk does not repeat");
}

PatternMesh parse_pattern_mesh(const std::string& bytes)
{
    PolygonMesh polygons = parse_mesh(bytes, ".obj");
    Triangulation triangulation = triangulate(polygons);
    if (triangulation.triangles.rows() == 0) throw InputError("the mesh of the pattern has no face");
    return {std::move(polygons.vertices), std::move(triangulation.triangles)};
}

}  // namespace

PatternFile read_pattern(const std::string& pattern, const LiftOptions& options)
{
    const std::string kind = is_pattern_file(pattern) ? io::lower_extension(pattern) : std::string();
    require_fitting_options(kind, options);
    PatternFile file;
    if (kind == ".svg") file.drawing = parse_svg(io::read_bytes(pattern));
    if (kind == ".png") file.image = parse_png(io::read_bytes(pattern));
    if (kind == ".obj") file.mesh = parse_pattern_mesh(io::read_bytes(pattern));
    return file;
}

}  // namespace koebe
