// Takes the place of libFuzzer's engine. Runs a target once on each file: `fuzz_TARGET FILE_OR_FOLDER...`.
// Any compiler can build this program, so the tests can run every target on its seeds and on former findings.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" [[gnu::weak]] int LLVMFuzzerInitialize(int* argc, char*** argv);

namespace {

namespace fs = std::filesystem;

std::size_t asked = 0;
std::string current;

void ask(const fs::path& file) {
  current = file.string();
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw fs::filesystem_error("cannot be read", file, std::make_error_code(std::errc::io_error));
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  ++asked;
}

void ask_all(const fs::path& path) {
  if (!fs::is_directory(path)) return ask(path);
  for (const auto& each : fs::recursive_directory_iterator(path))
    if (each.is_regular_file()) ask(each.path());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: %s FILE_OR_FOLDER...\n", argv[0]);
    return 2;
  }
  if (LLVMFuzzerInitialize != nullptr) LLVMFuzzerInitialize(&argc, &argv);
  try {
    for (int i = 1; i < argc; ++i) ask_all(argv[i]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", current.c_str(), error.what());
    return 1;
  }
  std::printf("%zu files\n", asked);
  return asked == 0 ? 2 : 0;
}
