#include "tests/proofs/gappa_process.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <regex>
#include <stdexcept>

#include "tests/proofs/numbers.hpp"

namespace nearmiss::proofs {

namespace {

struct Answer {
  int status;
  std::string text;
};

/// A file for as long as Gappa reads it.
class ScriptFile {
 public:
  explicit ScriptFile(const std::string& script) {
    const int file = mkstemp(path_.data());
    if (file < 0 || write(file, script.data(), script.size()) != static_cast<ssize_t>(script.size()))
      throw std::runtime_error("found no room for a script in " + path_);
    close(file);
  }
  ~ScriptFile() { unlink(path_.c_str()); }
  ScriptFile(const ScriptFile&) = delete;
  ScriptFile& operator=(const ScriptFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_ = "/tmp/nearmiss-gappa-XXXXXX";
};

/// Precision is what Gappa's own interval bounds are rounded to, in bits: finer than a double word's errors.
Answer run(const std::string& script) {
  const ScriptFile file(script);
  const std::string command = "gappa -Eprecision=400 " + file.path() + " 2>&1";
  FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("gappa does not start");
  Answer answer{};
  std::array<char, 4096> some{};
  for (std::size_t count = 0; (count = fread(some.data(), 1, some.size(), pipe)) > 0;)
    answer.text.append(some.data(), count);
  answer.status = pclose(pipe);
  const bool is_readable = answer.text.find("syntax error") == std::string::npos;
  if (!WIFEXITED(answer.status) || WEXITSTATUS(answer.status) > 1 || !is_readable)
    throw std::runtime_error("gappa: " + answer.text + "\n" + script);
  return answer;
}

}  // namespace

bool is_proven(const std::string& script) { return run(script).status == 0; }

double proven_upper_end(const std::string& script) {
  const Answer answer = run(script);
  // ... in [0, 774619135907725313b-112 {1.49186e-16, 2^(-52.5737)}]
  static const std::regex upper("in \\[[^,]*(?:\\{[^}]*\\})?, (-?[0-9]+)(?:b(-?[0-9]+))?[ \\]]");
  std::smatch match;
  if (answer.status != 0 || !std::regex_search(answer.text, match, upper))
    throw std::runtime_error("gappa proves no bound: " + answer.text + "\n" + script);
  Rational end(boost::multiprecision::mpz_int(match[1].str()));
  const int exponent = match[2].matched ? std::stoi(match[2].str()) : 0;
  for (int i = 0; i < std::abs(exponent); ++i) end *= exponent > 0 ? Rational(2) : Rational(1, 2);
  const auto near = end.convert_to<double>();
  return Rational(near) < end ? std::nextafter(near, HUGE_VAL) : near;
}

}  // namespace nearmiss::proofs
