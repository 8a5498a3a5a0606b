#include "io/glb_editor.h"

#include "core/errors.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <map>
#include <utility>

namespace koebe::io {
namespace {

using Json = GlbEditor::Json;

constexpr std::size_t alignment = 4;

/// Beginnings of the names of extensions that refer to no bytes, and to accessors only as the core does.
constexpr std::string_view known_extensions[] = {
    "KHR_materials_",        "KHR_texture_", "EXT_texture_",
    "MSFT_texture_dds",      "KHR_lights_",  "KHR_node_",
    "KHR_mesh_quantization", "KHR_xmp_",     "EXT_mesh_gpu_instancing",
    "KHR_animation_pointer", "VRM",
};

constexpr std::string_view accessor_members[] = {"indices", "input", "output", "inverseBindMatrices"};

bool is_any_of(std::string_view name, const auto& names) { return std::ranges::find(names, name) != std::end(names); }

bool knows_extensions(const Json& json)
{
    const auto known = [](std::string_view name) {
        return std::ranges::any_of(known_extensions, [&](auto begin) { return name.starts_with(begin); });
    };
    for (const auto& [name, value] : json.items()) {
        if (!value.is_structured()) continue;
        if (json.is_object() && name == "extensions" && value.is_object())
            for (const auto& [extension, settings] : value.items())
                if (!known(extension)) return false;
        if (!knows_extensions(value)) return false;
    }
    return true;
}

/// Visits each number that may name an accessor or a view: every member of the right name, in extensions and extras
/// too.
void visit_references(Json& json, const auto& visit_accessor, const auto& visit_view, bool attributes = false)
{
    for (auto& [name, value] : json.items()) {
        if (value.is_structured())
            visit_references(value, visit_accessor, visit_view,
                             attributes || name == "attributes" || name == "targets");
        else if (!value.is_number())
            continue;
        else if (name == "bufferView")
            visit_view(value);
        else if (attributes || is_any_of(name, accessor_members))
            visit_accessor(value);
    }
}

struct UsedNumbers {
    std::vector<char> accessors, views;
};

UsedNumbers used_numbers(Json& json, const tinygltf::Model& model)
{
    UsedNumbers used{std::vector<char>(model.accessors.size(), 0), std::vector<char>(model.bufferViews.size(), 0)};
    const auto mark = [](std::vector<char>& numbers) {
        return [&numbers](const Json& value) {
            const double number = value.get<double>();
            if (number >= 0.0 && number < static_cast<double>(numbers.size()))
                numbers[static_cast<std::size_t>(number)] = 1;
        };
    };
    visit_references(json, mark(used.accessors), mark(used.views));
    return used;
}

/// Moves the items from `old_count` on to these places, and those without a place (-1) up to the end of the old ones.
/// @return renumbers a reference to one of these items
auto put_at_places(Json& items, std::size_t old_count, const std::vector<int>& places)
{
    std::vector<std::size_t> numbers;
    std::size_t end = old_count;
    for (std::size_t k = 0; k < places.size(); ++k) {
        numbers.push_back(places[k] < 0 ? end++ : static_cast<std::size_t>(places[k]));
        if (numbers[k] != old_count + k) items[numbers[k]] = std::move(items[old_count + k]);
    }
    while (items.size() > end) items.erase(items.size() - 1);
    return [old_count, numbers](Json& reference) {
        if (!reference.is_number_integer()) return;
        const std::size_t k = reference.get<std::size_t>() - old_count;
        if (k < numbers.size()) reference = numbers[k];
    };
}

/// Where bytes leave the binary data: the end of each gap, with the bytes that are missing up to there.
using Gaps = std::map<std::size_t, std::size_t>;

/// Takes the bytes out that only dropped views have.
/// @param dropped (views) whether a view of the first buffer goes
std::string without_dropped(std::string_view binary, const std::vector<tinygltf::BufferView>& views,
                            const std::vector<char>& dropped, Gaps& gaps)
{
    const auto aligned = [](std::size_t place) { return (place + alignment - 1) / alignment * alignment; };
    std::map<std::size_t, std::pair<int, int>> changes{{binary.size(), {}}};  // of the numbers of dropped, kept views
    for (std::size_t k = 0; k < views.size(); ++k) {
        if (views[k].buffer != 0) continue;
        const std::size_t first = std::min(views[k].byteOffset, binary.size()),
                          length = std::max<std::size_t>(views[k].byteLength, dropped[k] ? 0 : 1),
                          last = aligned(first + std::min(length, binary.size() - first)),
                          begin = dropped[k] ? std::min(aligned(first), last) : first / alignment * alignment;
        for (const auto& [place, change] : {std::pair(begin, 1), std::pair(last, -1)})
            (dropped[k] ? changes[place].first : changes[place].second) += change;
    }
    std::string rest;
    std::size_t place = 0;
    std::pair<int, int> covered;
    for (const auto& [next, change] : changes) {
        if (covered.first > 0 && covered.second == 0)
            gaps[next] = next - rest.size();
        else
            rest.append(binary.substr(place, next - place));
        place = next;
        covered = {covered.first + change.first, covered.second + change.second};
    }
    return rest;
}

}  // namespace

GlbEditor::GlbEditor(std::string_view glb)
    : file_(read_glb(glb)), model_(read_gltf_model(glb)), used_views_(used_numbers(file_.json, model_).views)
{
}

int GlbEditor::add(const std::string& data, std::size_t stride, Json accessor, int replaced)
{
    Json& buffers = file_.json["buffers"];
    if (buffers.empty()) buffers.push_back(Json::object({{"byteLength", 0}}));
    if (buffers[0].contains("uri"))  // else it has the binary chunk
        throw InputError("the first buffer of the GLB file is text: save the file with binary data");
    Json view{{"buffer", 0}, {"byteOffset", data_.size()}, {"byteLength", data.size()}};
    if (stride > 0) view["byteStride"] = stride;
    view["target"] = stride > 0 ? TINYGLTF_TARGET_ARRAY_BUFFER : TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;
    data_.append(data).append((alignment - data.size() % alignment) % alignment, '\0');
    Json& views = file_.json["bufferViews"];
    views.push_back(std::move(view));
    accessor["bufferView"] = views.size() - 1;
    file_.json["accessors"].push_back(std::move(accessor));
    replaced_.push_back(replaced);
    return static_cast<int>(file_.json["accessors"].size()) - 1;
}

int GlbEditor::with_copies(int number, const std::vector<Index>& sources, std::size_t count)
{
    const std::string elements = accessor_elements(model_, number, static_cast<std::ptrdiff_t>(count));
    const std::size_t size = accessor_element_bytes(model_.accessors[static_cast<std::size_t>(number)]);
    const std::size_t stride = (size + alignment - 1) / alignment * alignment;
    std::string data((count + sources.size()) * stride, '\0');
    const auto copy = [&](std::size_t from, std::size_t to) {
        std::memcpy(data.data() + to * stride, elements.data() + from * size, size);
    };
    for (std::size_t v = 0; v < count; ++v) copy(v, v);
    for (std::size_t k = 0; k < sources.size(); ++k) copy(static_cast<std::size_t>(sources[k]), count + k);
    Json accessor = file_.json["accessors"][static_cast<std::size_t>(number)];
    for (const char* old : {"byteOffset", "sparse"}) accessor.erase(old);
    accessor["count"] = count + sources.size();
    return add(data, stride, std::move(accessor), number);
}

void GlbEditor::place_accessors(std::vector<char> used)
{
    std::vector<int> places;
    for (const int number : replaced_) {
        const bool exists = number >= 0 && static_cast<std::size_t>(number) < used.size();
        const bool is_free = exists && !std::exchange(used[static_cast<std::size_t>(number)], 1);
        places.push_back(is_free ? number : no_accessor);
    }
    const auto renumber = put_at_places(file_.json["accessors"], used.size(), places);
    visit_references(file_.json["meshes"], renumber, [](Json&) {});
}

std::string GlbEditor::place_views(const std::vector<char>& used)
{
    Json& views = file_.json["bufferViews"];
    std::vector<int> places(views.size() - used.size(), -1);
    std::vector<char> dropped(used.size(), 0);
    for (std::size_t k = 0, place = 0; k < used.size() && place < places.size(); ++k) {
        if (used[k] || !used_views_[k] || model_.bufferViews[k].buffer != 0) continue;
        places[place++] = static_cast<int>(k);
        dropped[k] = 1;
    }
    Gaps gaps;
    std::string binary = without_dropped(file_.binary, model_.bufferViews, dropped, gaps);
    for (std::size_t k = 0; k < used.size(); ++k) {
        const std::size_t offset = model_.bufferViews[k].byteOffset;
        const auto gap = gaps.upper_bound(offset);
        if (model_.bufferViews[k].buffer == 0 && gap != gaps.begin())
            views[k]["byteOffset"] = offset - std::prev(gap)->second;
    }
    for (std::size_t k = used.size(); k < views.size(); ++k)
        views[k]["byteOffset"] = binary.size() + views[k]["byteOffset"].get<std::size_t>();
    const auto renumber = put_at_places(views, used.size(), places);
    visit_references(
        file_.json["accessors"], [](Json&) {}, renumber);
    return binary;
}

std::string GlbEditor::bytes()
{
    if (replaced_.empty()) return glb_bytes(file_, {});
    const bool may_move = knows_extensions(file_.json);
    const auto used_now = [&] {
        UsedNumbers used = used_numbers(file_.json, model_);
        if (!may_move) std::ranges::fill(used.accessors, 1), std::ranges::fill(used.views, 1);
        return used;
    };
    place_accessors(used_now().accessors);
    const std::string binary = place_views(used_now().views);
    file_.binary = binary;
    file_.json["buffers"][0]["byteLength"] = binary.size() + data_.size();
    return glb_bytes(file_, data_);
}

}  // namespace koebe::io
