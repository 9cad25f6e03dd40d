// libFuzzer target: the reader of stores, *.db, and everything that commands do with what it accepts.
#include "reports/store/store.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "fuzz/libfuzzer/reader_target.hpp"
#include "fuzz/libfuzzer/store_mutation.hpp"
#include "reports/csv.hpp"
#include "reports/report.hpp"
#include "reports/text/json.hpp"

namespace nearmiss::libfuzzer {

namespace {

namespace fs = std::filesystem;

/// A folder for the files of one input.
class Folder {
 public:
  Folder() {
    std::string path = (fs::temp_directory_path() / "nearmiss-XXXXXX").string();
    expect(mkdtemp(path.data()) != nullptr, "a folder for temporary files");
    path_ = path;
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(path_); }

  [[nodiscard]] fs::path file(const char* name) const { return path_ / name; }

 private:
  fs::path path_;
};

std::string content(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// Writes a campaign, reads it and writes it again: both files must have the same bytes.
void expect_round_trip(const Campaign& campaign, const Folder& folder) {
  write_campaign(campaign, folder.file("once.db"));
  write_campaign(load_campaign(folder.file("once.db")), folder.file("twice.db"));
  expect(content(folder.file("once.db")) == content(folder.file("twice.db")), "the same store");
}

void report(const Campaign& campaign) {
  report_json(campaign, {.baseline = {campaign}}).dump();
  statistics_csv(campaign.statistics);
  classes_csv(campaign.statistics);
  distances_csv(campaign.statistics);
  times_csv(campaign.statistics);
  findings_csv(campaign);
}

void resume(const fs::path& file) {
  Store store(file);
  const Campaign campaign = load_campaign(file);
  store.save(campaign.statistics, campaign.runs.front().shards.front(), campaign.runs.front().findings);
}

/// Runs a command, which may throw Error.
template <class Command>
void run(const Command& command) {
  try {
    command();
  } catch (const Error&) {  // refused
  }
}

}  // namespace

void read(std::istream& in) {
  const Folder folder;
  const fs::path file = folder.file("input.db");
  std::ofstream(file, std::ios::binary) << in.rdbuf();
  run([&] { expect_round_trip(salvage_campaign(file).campaign, folder); });
  run([&] { report(load_campaigns({&file, 1})); });
  run([&] { resume(file); });
}

}  // namespace nearmiss::libfuzzer

extern "C" [[gnu::weak]] std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size,
                                                      std::size_t max_size);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  nearmiss::Random random(seed, 0, 0);
  const auto mutate_bytes = [&](std::string_view bytes) {
    std::string changed(bytes.substr(0, max_size));
    const std::size_t before = changed.size();
    changed.resize(std::min(before + 64, max_size));
    changed.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(changed.data()), before, changed.size()));
    return changed;
  };
  const std::string store =
      nearmiss::libfuzzer::mutated_store(random, {reinterpret_cast<const char*>(data), size}, mutate_bytes);
  if (store.empty() || store.size() > max_size) return size;
  std::copy(store.begin(), store.end(), data);
  return store.size();
}
