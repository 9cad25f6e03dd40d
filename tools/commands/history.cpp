// nearmiss history: the reports of many nights as one page.
#include "reports/history/history.hpp"

#include <fmt/format.h>

#include "ccd/query/printable.hpp"
#include "corpus/file.hpp"
#include "reports/page/page.hpp"
#include "reports/text/json.hpp"
#include "tools/commands.hpp"
#include "tools/json_output.hpp"

namespace nearmiss::tools {

namespace {

struct Options {
  std::filesystem::path folder;
  JsonOutput json;
};

void run(const Options& options) {
  const std::filesystem::path page = options.folder / "index.html";
  options.json.expect_writable();
  expect_different({options.json.file(), "--json"}, {page, "FOLDER"});
  const History history = make_history(read_nights(options.folder));
  const nlohmann::ordered_json json = history_json(history);
  replace_file(page, history_page(json));
  options.json.write(json);
  fmt::print(options.json.text(), "{}history: {}\n", describe(history),
             printable(std::filesystem::absolute(page).lexically_normal().string()));
}

}  // namespace

void add_history(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<Options>();
  auto* command = app.add_subcommand(
      "history",
      "Write FOLDER/index.html: what changed in each night, from the reports of nights in a folder");
  command
      ->add_option("FOLDER", options->folder,
                   "Folder of nights, such as build/nightly: each in a folder with report/report.json")
      ->required()
      ->type_name("FOLDER");
  options->json.add_to(*command, "Write the history as JSON");
  command->callback([options, &exit_code] {
    run(*options);
    exit_code = exit_fine;
  });
}

}  // namespace nearmiss::tools
