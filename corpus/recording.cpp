#include "corpus/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include "ccd/nearmiss_record.h"
#include "ccd/query/error.hpp"
#include "corpus/file.hpp"

namespace nearmiss {

namespace {

/// Converts a record. Returns nothing if the record's kind is unknown.
std::optional<Recorded> recorded(const nearmiss_record_slot& slot) {
  const auto kind = kind_of_bit(slot.kind);
  if (!kind) return std::nullopt;
  Recorded each{.number = slot.number,
                .query = query_of(*kind, slot.x),
                .tmax = slot.tmax,
                .answer = slot.answer,
                .time = slot.toi,
                .is_float = slot.is_float != 0,
                .is_kept = (slot.flags & NEARMISS_KEEP) != 0};
  each.query.separation = slot.separation;
  return each;
}

bool is_usable(const Recorded& each) {
  const double h = each.query.separation;
  return is_finite(each.query) && std::isfinite(h) && h >= 0 && std::isfinite(each.tmax) && each.tmax > 0 &&
         is_finite(each.asked());
}

nearmiss_recording head_of(const std::string& bytes, const std::string& name) {
  nearmiss_recording head{};
  if (bytes.size() < sizeof head ||
      std::memcmp(bytes.data(), NEARMISS_RECORDING_MAGIC, sizeof head.magic) != 0)
    throw Error(fmt::format("{}: found no recording, expected a file that nearmiss_record.h wrote", name));
  std::memcpy(&head, bytes.data(), sizeof head);
  if (head.byte_order != NEARMISS_RECORDING_BYTE_ORDER || head.version != NEARMISS_RECORDING_VERSION)
    throw Error(
        fmt::format("{}: found a recording of version {} or of another processor, expected version {}", name,
                    head.version, NEARMISS_RECORDING_VERSION));
  return head;
}

}  // namespace

Query Recorded::asked() const {
  if (tmax == 1) return query;
  Query shorter = query;
  constexpr std::size_t half = 12;
  for (std::size_t i = 0; i < half; ++i)
    shorter.x[half + i] = query.x[i] + tmax * (query.x[half + i] - query.x[i]);
  return shorter;
}

bool begins_as_recording(std::istream& in) {
  constexpr std::string_view magic = NEARMISS_RECORDING_MAGIC;
  std::string begin(magic.size(), '\0');
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  in.clear();
  in.seekg(0);
  return begin == magic;
}

UnusedRecords read_recording(const std::filesystem::path& file,
                             const std::function<void(const Recorded&)>& sink) {
  const std::string bytes = read_whole_file(file);
  const nearmiss_recording head = head_of(bytes, file.string());
  const std::uint64_t slots = head.slots + head.kept_slots;
  const std::size_t present = (bytes.size() - sizeof head) / sizeof(nearmiss_record_slot);
  std::vector<nearmiss_record_slot> all(std::min<std::uint64_t>(slots, present));
  std::memcpy(all.data(), bytes.data() + sizeof head, all.size() * sizeof(nearmiss_record_slot));

  UnusedRecords unused;
  // The number of places, in both parts of the file, to which the program has written or begun to write a
  // record. If the file was cut off, some of these places are lost.
  const auto filled = std::min(head.next_slot[0], head.slots) + std::min(head.next_kept[0], head.kept_slots);
  std::erase_if(all, [](const nearmiss_record_slot& each) {
    return each.number == 0 || nearmiss_record_check(&each) != each.check;
  });
  unused.unfinished = filled > all.size() ? filled - all.size() : 0;
  std::ranges::sort(all, {}, &nearmiss_record_slot::number);
  for (const nearmiss_record_slot& slot : all) {
    const auto each = recorded(slot);
    if (each && is_usable(*each))
      sink(*each);
    else
      ++unused.not_queries;
  }
  return unused;
}

}  // namespace nearmiss
