#include "tests/proofs/gappa_process.hpp"

#include <fmt/format.h>
#include <stdlib.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "tests/proofs/numbers.hpp"

namespace nearmiss::proofs {

namespace {

/// A temporary file with a text. The destructor removes the file.
class ScriptFile {
 public:
  explicit ScriptFile(const std::string& text) {
    const int file = mkstemp(path_.data());
    if (file < 0) throw std::runtime_error("cannot make a temporary file for gappa");
    const bool all = write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    close(file);
    if (!all) throw std::runtime_error("a temporary file for gappa cannot be written");
  }
  ~ScriptFile() { std::filesystem::remove(path_); }
  ScriptFile(const ScriptFile&) = delete;
  ScriptFile& operator=(const ScriptFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_ = std::filesystem::temp_directory_path() / "gappa-XXXXXX";
};

std::pair<std::string, int> output_of(const std::string& command) {
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("gappa does not run");
  std::string output;
  std::array<char, 4096> part{};
  while (const std::size_t size = fread(part.data(), 1, part.size(), pipe)) output.append(part.data(), size);
  return {output, pclose(pipe)};
}

/// Whether Gappa warns of anything other than an unneeded hint or an abandoned search. In that case, Gappa
/// may have taken a hint on trust.
bool has_grave_warning(const std::string& output) {
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);)
    if (line.find("Warning") != std::string::npos &&
        line.find("relation already known") == std::string::npos &&
        line.find("maximum number of iterations reached") == std::string::npos)
      return true;
  return false;
}

/// Gappa's option for the precision of its interval bounds, in bits.
constexpr auto fine = "-Eprecision=400";

}  // namespace

GappaAnswer run_gappa(const std::string& script, const std::string& options) {
  const ScriptFile file(script);
  const auto [output, status] = output_of(fmt::format("{} {} {} 2>&1", NEARMISS_GAPPA, options, file.path()));
  const bool warns = has_grave_warning(output);
  const bool unproven = output.find("some properties were not satisfied") != std::string::npos ||
                        output.find("no contradiction was found") != std::string::npos;
  if (warns || (status != 0 && !unproven))
    throw std::runtime_error("gappa says: " + output + "\nof this script:\n" + script);
  return {output, status == 0};
}

bool is_proven(const std::string& script) { return run_gappa(script, fine).proven; }

double proven_upper_end(const std::string& script) {
  const GappaAnswer answer = run_gappa(script, fine);
  // ... in [0, 774619135907725313b-112 {1.49186e-16, 2^(-52.5737)}]
  static const std::regex upper("in \\[[^,]*(?:\\{[^}]*\\})?, (-?[0-9]+)(?:b(-?[0-9]+))?[ \\]]");
  std::smatch match;
  if (!answer.proven || !std::regex_search(answer.text, match, upper))
    throw std::runtime_error("gappa proves no bound: " + answer.text + "\n" + script);
  Rational end(boost::multiprecision::mpz_int(match[1].str()));
  const int exponent = match[2].matched ? std::stoi(match[2].str()) : 0;
  for (int i = 0; i < std::abs(exponent); ++i) end *= exponent > 0 ? Rational(2) : Rational(1, 2);
  const auto near = end.convert_to<double>();
  return Rational(near) < end ? std::nextafter(near, HUGE_VAL) : near;
}

}  // namespace nearmiss::proofs
