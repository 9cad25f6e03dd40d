// The identity of a plug-in's code, which must stay the same during a trial.
#include "fuzz/subjects/isolation/plugin_file.hpp"

#include <gmock/gmock.h>
#include <link.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstring>
#include <thread>

#include "fuzz/subjects/isolation/isolated_plugin.hpp"
#include "reports/sha256.hpp"
#include "tests/plugins.hpp"
#include "tests/refused.hpp"
#include "tests/temporary_folder.hpp"

namespace {

std::atomic<bool> clock_is_late{false};

}  // namespace

// Replaces time(2) in this executable.
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
  /// Replaces p.so by a built plug-in, with a new inode.
  void replace(const std::string& name) const {
    fs::copy_file(plugin(name), file("new"));
    fs::rename(file("new"), file("p.so"));
  }

  /// Overwrites the bytes of p.so.
  void overwrite(const std::string& name) const {
    fs::copy_file(plugin(name), file("p.so"), fs::copy_options::overwrite_existing);
  }

  [[nodiscard]] std::unique_ptr<Subject> make() const { return make_isolated_plugin(file("p.so").string()); }

  /// Expects that asking the plug-in fails with these words, because its file changed.
  template <class Ask>
  static void expect_changed(const Ask& ask, const std::string& words) {
    EXPECT_THAT(ask, ::testing::ThrowsMessage<isolation::PluginChanged>(::testing::HasSubstr(words)));
  }

  void expect_no_verdict(const Subject& subject, const std::string& words) const {
    expect_changed([&] { (void)subject.decide(query); }, words);
  }

  void expect_no_bound(const Subject& subject, const std::string& words) const {
    expect_changed([&] { (void)subject.ask_bound(query); }, words);
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

TEST_F(PluginFileTest, ThatWasReplacedIsNotAskedAgain) {
  replace("always");
  const auto subject = make();
  EXPECT_TRUE(subject->decide(query).hit);
  replace("never");
  const std::string expected = "p.so: the plug-in was changed while it was on trial: found sha256 " +
                               sha256_hex(read("p.so")) + ", expected the file with sha256 ";
  for (int i = 0; i < 2; ++i) expect_no_verdict(*subject, expected);
  expect_no_bound(*subject, expected);
}

TEST_F(PluginFileTest, ThatWasOverwrittenIsNotAskedAgain) {
  replace("always");
  const auto subject = make();
  overwrite("never");
  expect_no_verdict(*subject, "found sha256");
}

// The plug-in ends its process at each query, so that each query loads the file again.
TEST_F(PluginFileTest, ThatWasReplacedIsNotLoadedAfterACrash) {
  replace("bound_abort");
  const auto subject = make();
  EXPECT_EQ(subject->ask_bound(query).fault, Fault::crash);
  for (const char* other : {"always", "no_function", "throwing_while_loaded"}) {
    replace(other);
    expect_no_bound(*subject, "found sha256");
  }
}

TEST_F(PluginFileTest, ThatWasRemovedIsNotAskedAgain) {
  replace("always");
  const auto subject = make();
  fs::remove(file("p.so"));
  expect_no_verdict(*subject, "found no such file");
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

TEST_F(PluginFileTest, IsReadWithoutAStandardInput) {
  replace("example");
  const int input = dup(STDIN_FILENO);
  close(STDIN_FILENO);
  EXPECT_NO_THROW(isolation::PluginFile(file("p.so").string()));
  dup2(input, STDIN_FILENO);
  close(input);
}

/// The number of bytes that this process has read from files.
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

/// An ELF file with these notes in its only segment.
std::string elf_with(const std::string& notes) {
  ElfW(Ehdr) header{};
  std::memcpy(header.e_ident, ELFMAG, SELFMAG);
  header.e_phoff = sizeof header;
  header.e_phnum = 1;
  ElfW(Phdr) segment{};
  segment.p_type = PT_NOTE;
  segment.p_offset = sizeof header + sizeof segment;
  segment.p_filesz = notes.size();
  std::string elf(reinterpret_cast<const char*>(&header), sizeof header);
  return elf.append(reinterpret_cast<const char*>(&segment), sizeof segment) + notes;
}

std::string note(std::uint32_t type, std::string name, std::string content) {
  const ElfW(Nhdr)
      header{static_cast<std::uint32_t>(name.size()), static_cast<std::uint32_t>(content.size()), type};
  name.resize((name.size() + 3) / 4 * 4);
  content.resize((content.size() + 3) / 4 * 4);
  return std::string(reinterpret_cast<const char*>(&header), sizeof header) + name + content;
}

const std::string gnu("GNU\0", 4);

TEST(BuildId, IsTheContentOfItsNote) {
  const std::string id = note(NT_GNU_BUILD_ID, gnu, "\x01\xab\xff");
  EXPECT_EQ(gnu_build_id(elf_with(id)), "01abff");
  EXPECT_EQ(gnu_build_id(elf_with(note(NT_GNU_ABI_TAG, gnu, "12345") + id)), "01abff");
  EXPECT_EQ(gnu_build_id(elf_with(note(NT_GNU_BUILD_ID, "other", "1234"))), "");
  EXPECT_EQ(gnu_build_id("no ELF file"), "");
}

TEST(BuildId, OfAFileThatEndsTooSoonIsCutOrEmpty) {
  const std::string elf = elf_with(note(NT_GNU_BUILD_ID, gnu, "1234"));
  for (std::size_t size = 0; size <= elf.size(); ++size)
    EXPECT_EQ(std::string("31323334").rfind(gnu_build_id(elf.substr(0, size)), 0), 0) << size;
  std::string endless = elf_with(note(0, std::string(4, 'x'), ""));
  endless.replace(endless.size() - 16, 8, std::string(8, '\xff'));
  EXPECT_EQ(gnu_build_id(endless), "");
}

}  // namespace
}  // namespace nearmiss
