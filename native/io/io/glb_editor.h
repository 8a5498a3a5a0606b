// A GLB file in which accessors are replaced. Data that only the old accessors used leave the file.
#pragma once

#include "core/types.h"
#include "io/glb_container.h"
#include "io/gltf_model.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace koebe::io {

class GlbEditor {
public:
    using Json = nlohmann::ordered_json;
    static constexpr int no_accessor = -1;

    /// @param glb stays in place as long as the editor is used
    /// @throws InputError as read_gltf_model
    explicit GlbEditor(std::string_view glb);

    /// The JSON of the file, to be changed where it refers to no data.
    Json& json() { return file_.json; }

    /// Primitive `place` of a mesh, to be changed.
    Json& primitive(std::size_t mesh, std::size_t place) { return file_.json["meshes"][mesh]["primitives"][place]; }

    /// Adds an accessor of new data.
    /// @param stride bytes, of vertex attributes; 0: indices
    /// @param accessor its JSON, without the buffer view @param replaced the accessor that it stands for
    /// @return its number, until bytes()
    /// @throws InputError the first buffer is text
    int add(const std::string& data, std::size_t stride, Json accessor, int replaced);

    /// Adds an accessor with the elements of accessor `number`, and copies of the elements `sources` behind them.
    /// @param count of the elements of `number` @return as add()
    /// @throws InputError as accessor_elements
    int with_copies(int number, const std::vector<Index>& sources, std::size_t count);

    /// The file. A new accessor gets the number of the accessor that it replaces, if nothing else refers to that one.
    /// Buffer views that nothing uses any more give their numbers to new views, and their bytes leave the file: the
    /// data behind them move up by a multiple of 4 bytes. All other bytes stay as they are. If the file has an
    /// extension that may refer to data in ways not known here, new accessors, views and data only follow the old ones.
    /// @throws InputError over 4 GiB
    std::string bytes();

private:
    void place_accessors(std::vector<char> used);
    std::string place_views(const std::vector<char>& used);

    GlbContainer file_;
    tinygltf::Model model_;
    std::vector<char> used_views_;  // before any change
    std::string data_;              // new, in multiples of 4 bytes
    std::vector<int> replaced_;     // by each new accessor
};

}  // namespace koebe::io
