// Recordings: the queries that a simulation asked its CCD, and the answers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>

#include "ccd/query/query.hpp"

namespace nearmiss {

/// A record that ccd/nearmiss_record.h wrote.
struct Recorded {
  std::uint64_t number;  ///< the number of the record, from 1 on, in the order of the calls
  Query query;
  double tmax;    ///< the CCD was asked about t in [0, tmax]
  int answer;     ///< as in nearmiss_subject.h
  double time;    ///< the time that the CCD gave; NaN if the CCD gave no time
  bool is_float;  ///< whether the program computes in float
  bool is_kept;   ///< whether the record has the flag NEARMISS_KEEP

  /// The recorded query, in which the step is shortened so that it ends at the time `tmax`. The positions of
  /// the vertices at tmax are computed in double.
  [[nodiscard]] Query asked() const;
};

/// How many records of a file cannot be used, and why.
struct UnusedRecords {
  std::uint64_t unfinished = 0;   ///< records that the program did not complete, or that the file has lost
  std::uint64_t not_queries = 0;  ///< complete records with a kind, a number or a tmax that no query can have
};

/// Returns whether a stream begins as a recording does. Afterwards, the stream is at its beginning again.
bool begins_as_recording(std::istream& in);

/// Passes the usable records of a file to `sink`, in the order in which the program called its CCD. Throws
/// Error if the file is not a recording of this version.
UnusedRecords read_recording(const std::filesystem::path& file,
                             const std::function<void(const Recorded&)>& sink);

}  // namespace nearmiss
