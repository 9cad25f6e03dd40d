#include "corpus/readers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <istream>
#include <optional>
#include <vector>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "corpus/file.hpp"
#include "corpus/line_reader.hpp"
#include "corpus/query_text.hpp"
#include "corpus/recording.hpp"
#include "corpus/sample_csv.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;

/// The kind of the queries in a file whose name ends in the kind, such as *.vt.
std::optional<Kind> kind_of_extension(const fs::path& extension) {
  for (const Kind kind : kinds)
    if (extension == fmt::format(".{}", short_name(kind))) return kind;
  return std::nullopt;
}

bool is_case_file(const fs::path& path) {
  const auto extension = path.extension();
  return extension == ".case" || extension == ".csv" || extension == ".nmq" || kind_of_extension(extension);
}

/// Throws Error if reading failed before the end of the file.
void expect_end(const std::istream& in, const std::string& name) {
  if (in.bad()) throw Error(fmt::format("{}: cannot be read to its end", name));
}

/// Passes the records of a recording to `sink` as cases. Throws Error if the recording has no usable record.
void read_records(const fs::path& path, const CaseSink& sink) {
  const std::string name = path.string();
  bool any = false;
  const UnusedRecords unused = read_recording(path, [&](const Recorded& each) {
    any = true;
    sink({.name = fmt::format("{}:{}", name, each.number), .query = each.asked()});
  });
  if (any) return;
  const bool has_records = unused.unfinished + unused.not_queries > 0;
  throw Error(fmt::format("{}: found no {}, expected some", name,
                          has_records ? "record that is complete and has a query" : "record"));
}

void read_file(const fs::path& path, const CaseSink& sink) {
  const std::string name = path.string();
  expect_regular_file(path);
  std::ifstream in(path);
  if (!in) throw Error(fmt::format("{}: cannot be read", name));
  if (in.peek() == std::ifstream::traits_type::eof())
    throw Error(fmt::format("{}: found an empty file, expected cases", name));
  const auto extension = path.extension();
  // A program may record to a file with any name, so a file is also a recording if its content begins like
  // one.
  if (extension == ".nmq" || begins_as_recording(in)) return read_records(path, sink);
  if (extension == ".case") {
    sink(parse_case(in, name));
  } else if (extension == ".csv") {
    read_sample_csv(in, path, sink);
  } else if (const auto kind = kind_of_extension(extension)) {
    read_query_lines(in, *kind, name, sink);
  } else {
    throw Error(fmt::format("{}: found an unknown kind of file, expected *.case, *.csv, *.nmq, {}", name,
                            names_of_kinds("*.")));
  }
  expect_end(in, name);
}

/// Reads the truth that a comment " expect=1 ..." records for the next query. If the comment says "expect=-"
/// or "expect=?", `truth` becomes empty. Other comments change nothing.
void read_truth(std::string_view comment, std::string_view where, std::optional<bool>& truth) {
  constexpr std::string_view label = "expect=";
  comment.remove_prefix(std::min(comment.find_first_not_of(" \t#"), comment.size()));
  if (!comment.starts_with(label)) return;
  comment.remove_prefix(label.size());
  const std::string_view value = comment.substr(0, comment.find_first_of(" \t\r"));
  if (value != "0" && value != "1" && value != "-" && value != "?")
    throw Error(
        fmt::format("{}: found 'expect={}', expected expect=0, expect=1 or expect=-", where, excerpt(value)));
  truth.reset();
  if (value == "0" || value == "1") truth = value == "1";
}

}  // namespace

void read_cases(const fs::path& path, const CaseSink& sink) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return read_file(path, sink);
  std::vector<fs::path> files;
  for (auto it = fs::recursive_directory_iterator(path, error); it != fs::recursive_directory_iterator();
       it.increment(error))
    if (it->is_regular_file() && is_case_file(it->path())) files.push_back(it->path());
  if (error) throw Error(fmt::format("{}: cannot be read: {}", path.string(), error.message()));
  if (files.empty())
    throw Error(fmt::format("{}: found no case, expected *.case, *.csv, *.nmq, {} files", path.string(),
                            names_of_kinds("*.")));
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) read_file(file, sink);
}

void read_query_lines(std::istream& in, Kind kind, const std::string& name, const CaseSink& sink) {
  bool any = false;
  std::optional<bool> truth;
  LineReader lines(in, name);
  while (lines.next()) {
    std::string where = lines.where();
    const std::string_view text = lines.text().substr(0, lines.text().find('#'));
    if (text.find_first_not_of(" \t\r,") == std::string_view::npos) {
      if (text.size() < lines.text().size()) read_truth(lines.text().substr(text.size()), where, truth);
      continue;
    }
    Case each;
    each.query = parse_line(kind, text, where);
    each.name = std::move(where);
    each.truth = truth;
    truth = std::nullopt;
    any = true;
    sink(std::move(each));
  }
  expect_end(in, name);
  if (!any)
    throw Error(fmt::format("{}:{}: found no query, expected {} numbers a line", name, lines.number(),
                            coordinate_count(kind)));
}

}  // namespace nearmiss
