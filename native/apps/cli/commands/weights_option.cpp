#include "cli/commands/weights_option.h"

#include "cli/files/weights_file.h"
#include "cli/options/option_table.h"

namespace koebe::cli {

void WeightsOption::add(CLI::App& app, const char* map, const char* name)
{
    name_ = name;
    if (const OptionRow* const row = find_row(map, name))
        app.add_option(row->flag(), file_, std::string(row->does))->type_name("FILE");
}

void WeightsOption::check(MapRequest& request) const
{
    if (!is_given()) return;
    require_different_files(map_files(request), {request.input, file_}, !request.quiet);
    request.entries["options"][name_] = true;
}

std::vector<double> WeightsOption::read(const char* article_name) const
{
    return is_given() ? read_weights(file_, article_name) : std::vector<double>{};
}

}  // namespace koebe::cli
