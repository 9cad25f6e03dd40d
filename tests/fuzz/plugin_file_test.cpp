// The identity of a plug-in's code, which must stay the same during a trial.
#include "fuzz/subjects/isolation/plugin_file.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "fuzz/subjects/isolation/isolated_plugin.hpp"
#include "reports/sha256.hpp"
#include "tests/plugins.hpp"
#include "tests/refused.hpp"
#include "tests/temporary_folder.hpp"

namespace {

std::atomic<bool> clock_is_late{false};

}  // namespace

// Replaces time(2) in this executable, so that a test can set the clock back.
extern "C" time_t time(time_t* seconds) noexcept {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  const time_t result = now.tv_sec - (clock_is_late ? 3600 : 0);
  if (seconds != nullptr) *seconds = result;
  return result;
}

namespace nearmiss {
namespace {

using isolation::gnu_build_id;
using testing::plugin;

namespace fs = std::filesystem;

class PluginFileTest : public testing::TemporaryFolder {
 protected:
  /// Replaces the file p.so by a copy of a built plug-in, which gets a new inode.
  void replace(const std::string& name) const {
    fs::copy_file(plugin(name), file("new"));
    fs::rename(file("new"), file("p.so"));
  }

  void overwrite(const std::string& name) const {
    fs::copy_file(plugin(name), file("p.so"), fs::copy_options::overwrite_existing);
  }

  [[nodiscard]] std::unique_ptr<Subject> make() const { return make_isolated_plugin(file("p.so").string()); }

  /// Expects that a question to the plug-in throws PluginChanged with a message that has these words.
  void expect_changed(const Subject& subject, const std::string& words) const {
    using ::testing::HasSubstr;
    using ::testing::ThrowsMessage;
    for (int i = 0; i < 2; ++i)
      EXPECT_THAT([&] { (void)subject.decide(query); },
                  ThrowsMessage<isolation::PluginChanged>(HasSubstr(words)));
    EXPECT_THAT([&] { (void)subject.ask_bound(query); },
                ThrowsMessage<isolation::PluginChanged>(HasSubstr(words)));
  }

  const Query query = testing::falling_edge(1, -1);
};

TEST_F(PluginFileTest, IsIdentified) {
  replace("example");
  const auto subject = make();
  const auto identity = plugin_identity(*subject).value();
  EXPECT_EQ(identity.path, file("p.so").string());
  EXPECT_EQ(identity.version, "1.0");
  EXPECT_EQ(identity.sha256, sha256_hex(read("p.so")));
  EXPECT_EQ(identity.build_id, gnu_build_id(read("p.so")));
  EXPECT_EQ(plugin_identity(*make_subject("wang")), std::nullopt);
}

TEST_F(PluginFileTest, ThatWasChangedIsNotAskedAgain) {
  replace("always");
  const auto replaced = make();
  EXPECT_TRUE(replaced->decide(query).hit);
  replace("never");
  expect_changed(*replaced, "p.so: the plug-in was changed while it was on trial: found sha256 " +
                                sha256_hex(read("p.so")) + ", expected the file with sha256 ");
  const auto overwritten = make(), removed = make();
  overwrite("bounded");
  expect_changed(*overwritten, "found sha256");
  fs::remove(file("p.so"));
  expect_changed(*removed, "found no such file");
}

// The plug-in ends its process at each query, so nearmiss must load the file again for each query.
TEST_F(PluginFileTest, ThatWasReplacedIsNotLoadedAfterACrash) {
  replace("bound_abort");
  const auto subject = make();
  EXPECT_EQ(subject->ask_bound(query).fault, Fault::crash);
  for (const char* other : {"always", "no_function", "throwing_while_loaded"}) {
    replace(other);
    expect_changed(*subject, "found sha256");
  }
}

TEST_F(PluginFileTest, WithTheSameBytesIsTheSame) {
  replace("always");
  const auto subject = make();
  replace("always");
  EXPECT_TRUE(subject->decide(query).hit);
  overwrite("always");
  EXPECT_TRUE(subject->decide(query).hit);
}

TEST_F(PluginFileTest, LoadsLibrariesBesideIt) {
  replace("finds_beside");
  EXPECT_REFUSED(make(), "libbeside.so");
  fs::copy_file(plugin("libbeside"), file("libbeside.so"));
  EXPECT_TRUE(make()->decide(query).hit);
}

TEST_F(PluginFileTest, MustBeARegularFile) {
  fs::create_directory(file("p.so"));
  EXPECT_REFUSED(make(), "p.so: cannot load the plug-in: found no regular file");
}

std::uint64_t bytes_read() {
  std::ifstream counts("/proc/self/io");
  std::string rchar;
  std::uint64_t bytes = 0;
  counts >> rchar >> bytes;
  return bytes;
}

TEST_F(PluginFileTest, IsReadOnceEvenIfOurClockIsBehindThatOfItsFileSystem) {
  replace("example");
  const auto size = fs::file_size(file("p.so"));
  clock_is_late = true;
  const isolation::PluginFile plugin_file(file("p.so").string());
  std::this_thread::sleep_for(std::chrono::milliseconds(2100));
  plugin_file.expect_unchanged(Stop::never());
  const std::uint64_t before = bytes_read();
  plugin_file.expect_unchanged(Stop::never());
  EXPECT_LT(bytes_read() - before, size);
  clock_is_late = false;
}

TEST_F(PluginFileTest, HasAtMostTwoGibibytes) {
  replace("always");
  fs::resize_file(file("p.so"), (std::uintmax_t{1} << 31) + 1);
  EXPECT_REFUSED(make(), "found 2147483649 bytes, expected a shared object of at most 2 GiB");
}

TEST_F(PluginFileTest, HasABuildIdUnlessItEndsTooSoon) {
  replace("always");
  const std::string elf = read("p.so"), id = gnu_build_id(elf);
  EXPECT_EQ(id.size(), 40);  // the length of a SHA-1 digest
  replace("never");
  EXPECT_NE(id, gnu_build_id(read("p.so")));
  for (std::size_t size = 0; size <= elf.size(); size += size < 2000 ? 1 : 100)
    EXPECT_EQ(id.rfind(gnu_build_id(elf.substr(0, size)), 0), 0) << size;
  EXPECT_EQ(gnu_build_id("no ELF file"), "");
}

}  // namespace
}  // namespace nearmiss
