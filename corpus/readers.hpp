// Readers of files and folders of cases, in all formats.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>

#include "corpus/case.hpp"

namespace nearmiss {

/// Receives one case at a time, so that a file may have any length.
using CaseSink = std::function<void(Case&&)>;

/// Reads a file, or all files below a folder in the order of their paths. The name of a file determines its
/// format:
///  - *.case: one case (case.hpp);
///  - *.csv: sample queries of eight rows each. A row of the file has x y z as rational numbers (numerator,
///    denominator), and the truth. Every coordinate must be exactly a double. The name of the folder
///    (edge-edge or vertex-face), or the end of the file's name (ee or vf), determines the kind. The column
///    of truths may be missing. In this case, the truths of FOLDER/NAME.csv are read from
///    FOLDER/../mma_bool/NAME_mma_bool.json, if that file exists. It has an array of true and false, as in
///    CCD-Query-IO;
///  - *.nmq: a recording (recording.hpp); the step of each query ends at the tmax of its record. If `path`
///    leads directly to a recording, the recording may have any name;
///  - *.vt, *.ee, *.vv, *.ve: one query a line (parse_line); '#' starts a comment.
/// A byte order mark at the beginning of a file is skipped. In a folder, files with other names are ignored.
/// Throws an Error that names the file, and the line if a line is wrong. It is also an error if a file is
/// empty, unreadable or of another format, if a line has more than 1 MiB, if a recording has no usable
/// record, or if a folder has no case.
void read_cases(const std::filesystem::path& path, const CaseSink& sink);

/// Reads a stream with one query a line. Error messages call the stream `name`. Throws Error if a line is not
/// a query, or if the stream has no query.
void read_query_lines(std::istream& in, Kind kind, const std::string& name, const CaseSink& sink);

}  // namespace nearmiss
