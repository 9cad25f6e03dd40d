#include <fstream>
#include <iostream>

#include "tools/certificates/check.hpp"

constexpr auto help =
    R"(check_certificates [-q] [FILE...] checks certificates, one a line; - or no FILE is standard input.
It prints 'FILE:LINE: refused: REASON' and a summary; -q: only the summary.
Exit code: 0 all are accepted, 1 one is refused, 2 a line is no JSON object, or a file is empty or unreadable.
)";

int main(int argc, char** argv) try {
  std::vector<std::string> files(argv + 1, argv + argc);
  if (std::erase(files, "--help") + std::erase(files, "-h") > 0) return std::cout << help, 0;
  const bool quiet = std::erase(files, "-q") > 0;
  if (files.empty()) files = {"-"};
  std::size_t accepted = 0, all = 0;
  for (const std::string& file : files) {
    std::ifstream opened(file);
    std::istream& in = file == "-" ? std::cin : opened;
    std::size_t number = 0;
    std::vector<char> line(certificates::longest_line + 2);
    for (; in.getline(line.data(), std::ssize(line)) || in.gcount() > 0; ++all) {
      const auto length = static_cast<std::size_t>(in.gcount()) - (in ? 1 - in.eof() : 0);  // without '\n'
      const std::string place = file + ":" + std::to_string(++number) + ": ";
      try {
        certificates::check({line.data(), length});
        ++accepted;
      } catch (const certificates::Unreadable& why) {
        throw std::runtime_error(place + why.what());
      } catch (const certificates::Refused& why) {
        if (!quiet) std::cout << place << "refused: " << why.what() << '\n';
      }
    }
    if (in.bad() || number == 0) throw std::runtime_error(file + ": cannot be read, or has no line");
  }
  std::cout << "accepted " << accepted << " of " << all << std::endl;
  if (!std::cout) throw std::runtime_error("standard output cannot be written");
  return accepted < all ? 1 : 0;
} catch (const std::exception& error) {
  std::cerr << "check: " << error.what() << '\n';
  return 2;
}
