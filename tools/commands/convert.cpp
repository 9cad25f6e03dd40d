// nearmiss convert: writes cases in another format.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "ccd/query/error.hpp"
#include "corpus/query_text.hpp"
#include "corpus/readers.hpp"
#include "corpus/sample_csv.hpp"
#include "oracle/oracle.hpp"
#include "reports/text/text.hpp"
#include "tools/commands.hpp"
#include "tools/new_file.hpp"
#include "tools/terminal.hpp"

namespace nearmiss::tools {

namespace {

namespace fs = std::filesystem;

struct ConvertOptions {
  std::vector<fs::path> paths;
  fs::path folder;
  std::string format = "plain";
};

/// Makes the folder that will contain `file`, and returns `file`.
fs::path in_folder(fs::path file) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  return file;
}

/// New files in a folder. Each file keeps a temporary name until all files are complete.
class NewFiles {
 public:
  explicit NewFiles(fs::path folder) : folder_(std::move(folder)) {}

  void write(const fs::path& name, const std::string& text) {
    auto place = files_.find(name);
    if (place == files_.end()) place = files_.try_emplace(name, in_folder(folder_ / name)).first;
    place->second.write(text);
  }

  void finish() {
    for (auto& [name, file] : files_) file.close();
    for (auto& [name, file] : files_) file.put_in_place();
  }

 private:
  fs::path folder_;
  std::map<fs::path, NewFile> files_;
};

/// For a query in the format "plain", "csv" or "json": the file that holds the query, and the lines of this
/// file that belong to the query. In the formats "plain" and "csv", these lines include the exact truth.
/// Throws Error if the format cannot hold the query.
std::pair<fs::path, std::string> converted(const std::string& format, const Case& each, bool truth) {
  const Query& query = each.query;
  if (format == "plain")
    return {fmt::format("queries.{}", short_name(query.kind)),
            fmt::format("# expect={:d}\n{}\n", truth, to_line(query))};
  const auto names = sample_names(query.kind);
  if (!names || query.separation > 0)
    throw Error(fmt::format("{}: found a {} query{}, expected vt or ee for contact, which is all that {} has",
                            each.name, short_name(query.kind),
                            query.separation > 0 ? " with a separation" : "", format));
  if (format == "csv") return {fs::path(names->folder) / "queries.csv", to_sample_csv(query, truth)};
  return {fmt::format("queries/{}.csv", names->ending), to_sample_csv(query, std::nullopt)};
}

int run(const ConvertOptions& options) {
  NewFiles files(options.folder);
  std::uint64_t count = 0, wrong = 0;
  // For the format "json": the truths of the queries in each file.
  std::map<fs::path, std::vector<bool>> truths;
  for (const fs::path& path : options.paths)
    read_cases(path, [&](Case&& each) {
      ++count;
      // Asks earliest_time() in place of collides(): if the smallest distance is exactly the separation,
      // earliest_time() gives a time, but collides() answers no.
      const bool truth = earliest_time(each.query).has_value();
      if (each.truth && *each.truth != truth && each.query.separation == 0) ++wrong;
      if (options.format == "case") {
        // Writes each case file as soon as the case is read, because the system limits the number of files
        // that may be open at the same time.
        each.truth = truth;
        const fs::path file = in_folder(options.folder / fmt::format("{:06}.case", count));
        expect_new(file);
        write_case(each, file);
        return;
      }
      const auto [file, text] = converted(options.format, each, truth);
      files.write(file, text);
      if (options.format == "json") truths[sample_truths(file)].push_back(truth);
    });
  for (const auto& [file, of_queries] : truths)
    files.write(file, fmt::format("[{}]\n", fmt::join(of_queries, ", ")));
  files.finish();
  fmt::print("{} in {}\n", counted(count, "query", "queries"), options.folder.string());
  if (wrong > 0)
    fmt::print("{} wrong; the new files have the exact {}\n",
               counted(wrong, "recorded truth was", "recorded truths were"), wrong == 1 ? "one" : "ones");
  return exit_fine;
}

}  // namespace

void add_convert(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ConvertOptions>();
  auto* command = app.add_subcommand("convert", "Write cases in another format, with their exact truths");
  command
      ->add_option("PATH", options->paths,
                   "Files and folders that nearmiss replay reads, such as a recording")
      ->required();
  command->add_option("-o,--output", options->folder, "Folder of the new files")
      ->required()
      ->type_name("FOLDER");
  command
      ->add_option("--as", options->format,
                   "plain: queries.vt and so on, one query a line; csv: rational numbers, in vertex-face/ "
                   "and edge-edge/, for contact; json: likewise in queries/, with the truths as JSON in "
                   "mma_bool/; case: a file for each query")
      ->check(CLI::IsMember({"plain", "csv", "json", "case"}))
      ->capture_default_str();
  command->footer("\nExample: nearmiss convert run.nmq -o run --as csv");
  command->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace nearmiss::tools
