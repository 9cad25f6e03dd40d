#include "tools/campaign_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <span>
#include <tuple>

#include "ccd/query/error.hpp"
#include "ccd/query/excerpt.hpp"
#include "ccd/query/printable.hpp"
#include "corpus/file.hpp"
#include "corpus/query_text.hpp"
#include "corpus/readers.hpp"
#include "fuzz/scenes/near_families.hpp"
#include "fuzz/scenes/scene.hpp"
#include "fuzz/search/search.hpp"
#include "fuzz/subjects/exact.hpp"
#include "fuzz/trial/campaign.hpp"
#include "reports/sha256.hpp"
#include "reports/text/shell.hpp"
#include "reports/text/text.hpp"
#include "tools/arguments.hpp"
#include "tools/scene_subjects.hpp"
#include "tools/terminal.hpp"

namespace nearmiss::tools {

namespace {

using TimeLimit = std::optional<std::chrono::duration<double>>;

/// The finished fraction of the campaign: the fraction of its cases that are done, or the fraction of its
/// time that has passed, whichever is larger.
std::optional<double> part_done(const CampaignProgress& now, const TimeLimit& time) {
  std::optional<double> part;
  if (now.of != 0) part = static_cast<double>(now.cases) / static_cast<double>(now.of);
  if (time) part = std::max(part.value_or(0), now.elapsed / *time);
  return part;
}

std::string show(const CampaignProgress& now, const TimeLimit& time, const Statistics& statistics) {
  if (!now.is_asking) return shrinking_line(now.to_shrink);
  const double rate = static_cast<double>(now.cases - now.cases_before) / now.elapsed.count();
  std::string farthest = times_the_bound(0);
  double largest = 0;
  for (const auto& [key, counts] : statistics.counts)
    if (counts.max_ratio() > largest) {
      largest = counts.max_ratio();
      farthest = times_the_bound(largest, counts.distance_unit());
    }
  std::string line = with_separators(now.cases);
  if (now.of != 0) line += " of " + with_separators(now.of);
  line += fmt::format(" cases, {:.0f}/s, {} false negatives, farthest {}", rate,
                      with_separators(statistics.false_negatives()), farthest);
  if (const auto faults = statistics.faults(); faults != 0)
    line += fmt::format(", {} without answer", with_separators(faults));
  std::chrono::duration<double> left(static_cast<double>(now.of - now.cases) / rate);
  if (time) left = now.of != 0 ? std::min(left, *time - now.elapsed) : *time - now.elapsed;
  return show_duration(std::max(left, {})) + " left, " + line;
}

/// The kinds chosen with --kind; without --kind, the kinds that a campaign asks these subjects by default
/// (kinds_to_ask).
std::vector<Kind> chosen_kinds(const CampaignOptions& options, const Subjects& subjects) {
  if (options.kinds.empty()) {
    const bool of_meshes = !options.separation.of_families().empty();
    const bool of_vertices = of_meshes || !options.separation.is_given();  // as_asked() gives separations
    return kinds_to_ask(subjects, [&](Kind kind) { return is_of_meshes(kind) ? of_meshes : of_vertices; });
  }
  std::vector<Kind> chosen;
  for (const std::string& each : options.kinds) chosen.push_back(parse_kind(each, "--kind"));
  for (const Kind kind : chosen)
    if (std::ranges::count(chosen, kind) > 1)
      throw Error(fmt::format("--kind: found {} twice, expected different kinds", short_name(kind)));
  return chosen;
}

/// The family, restricted to the kinds `asked`. If the family has none of these kinds, returns the whole
/// family or, if the user has given --kind, throws Error.
Family with_kinds(const CampaignOptions& options, const Family& family, std::span<const Kind> asked) {
  if (const auto chosen = of_kinds(family, asked)) return *chosen;
  if (!options.kinds.empty()) expect_kind(family, asked.front(), "--kind");
  return family;
}

std::vector<Query> queries_of(const std::vector<std::filesystem::path>& paths) {
  std::vector<Query> queries;
  for (const auto& path : paths) read_cases(path, [&](Case&& each) { queries.push_back(each.query); });
  return queries;
}

/// The families chosen with --family, --sweep, --mesh, --near and --search. Throws Error for wrong options,
/// and Stopped if `stop` is due before the pairs of meshes and simulations are known.
std::vector<Family> chosen_families(const CampaignOptions& options, const Subjects& subjects,
                                    const Stop& stop) {
  const std::vector<Kind> asked = chosen_kinds(options, subjects);
  const std::string separation = options.separation.of_families();
  const bool asks_for_contact = options.separation.is_given() && separation.empty();
  std::vector<Family> known(families().begin(), families().end());
  if (!options.mesh.empty())
    with_kinds(options, known.emplace_back(mesh_family(open_scene(options.mesh), stop)), asked);
  std::vector<Family> near_within;
  for (const Family& each : near_families(queries_of(options.near)))
    if (of_kinds(each, asked))
      (each.has_separation || !is_of_meshes(each.kinds[0]) ? near_within : known).push_back(each);
  const std::size_t contact = known.size();
  known.insert(known.end(), separation_families().begin(), separation_families().end());
  const std::size_t of_meshes = known.size();
  known.insert(known.end(), vertex_families().begin(), vertex_families().end());
  known.insert(known.end(), near_within.begin(), near_within.end());
  // Some families of vt and ee queries have separations of their own. "all" includes these families only if
  // --separation is "drawn".
  std::vector<Family> all(
      known.begin(),
      known.begin() + static_cast<std::ptrdiff_t>(separation == drawn_separation ? of_meshes : contact));
  all.insert(all.end(), vertex_families().begin(), vertex_families().end());
  all.insert(all.end(), near_within.begin(), near_within.end());
  std::erase_if(all, [&](const Family& family) {
    return !of_kinds(family, asked) || (asks_for_contact && family.has_separation);
  });
  auto chosen = options.sweeps.empty() ? find_families(options.families, known, all, stop)
                                       : find_sweeps(options.sweeps, options.steps, known, all);
  const bool are_named = !options.sweeps.empty() || options.families != CampaignOptions().families;
  for (Family& family : chosen) {
    if (!separation.empty() && !family.has_separation) family = with_separation(family, separation);
    if (!options.separation.is_given()) family = as_asked(family);
    family = with_kinds(options, family, asked);
    // A family with separations does not ask subjects that take none. Such a subject is an error only if the
    // user names families or gives --separation.
    if (family.has_separation && (are_named || options.separation.is_given()))
      expect_separations(subjects, kinds_asked(family));
  }
  if (!options.search) return chosen;
  for (const auto& subject : subjects)
    for (const Family& family : searches(*subject, stop, separation))
      if (const auto some = of_kinds(family, asked); some && !(asks_for_contact && family.has_separation))
        chosen.push_back(*some);
  return chosen;
}

/// Does work that comes before the first query. Throws Stopped if the user ends the command. If the time
/// limit ends the work, throws Error with `why` in the message.
template <class Work>
auto in_time(const CampaignOptions& options, const Stop& stop, std::string_view why, const Work& work) {
  try {
    return work();
  } catch (const Stopped&) {
    if (stop.is_requested()) throw;
    throw Error(fmt::format("--time: found {}, expected more time: {}", excerpt(options.time), why));
  }
}

std::string names_of_kinds_asked(const CampaignPlan& plan) {
  int sum = 0;
  for (const Family& family : plan.families)
    for (const Kind kind : kinds_asked(family)) sum |= bit_of(kind);
  return names_of_kinds(sum, ",");
}

/// A digest of the content of the named files, and of all files below the named folders. Ignores a name that
/// is neither a file nor a folder.
template <class Paths>
std::string digest_of(const Paths& paths) {
  namespace fs = std::filesystem;
  Sha256 digest;
  std::vector<fs::path> files;
  for (const auto& given : paths) {
    const fs::path path(given);
    std::error_code none;
    if (fs::is_regular_file(path, none)) files.push_back(path);
    std::vector<fs::path> below;
    for (fs::recursive_directory_iterator each(path, none), end; !none && each != end; each.increment(none))
      if (each->is_regular_file()) below.push_back(each->path());
    std::ranges::sort(below);
    files.insert(files.end(), below.begin(), below.end());
  }
  for (const fs::path& file : files) digest.add(read_whole_file(file));
  return digest.hex_digest();
}

/// Everything on which the campaign's results depend, except the time limit. The time limit changes how many
/// cases the campaign asks, but not the result of a case.
RunInfo info_of(const CampaignOptions& options, const CampaignPlan& plan, const Subjects& subjects) {
  RunInfo info = options.trial.run_info("fuzz", subjects);
  std::string& again = info["again"];
  note_option(info, "seed", "--seed", fmt::format("{}", plan.seed));
  const std::string families =
      fmt::format("{}", fmt::join(options.sweeps.empty() ? options.families : options.sweeps, ","));
  if (options.sweeps.empty()) {
    note_option(info, "families", "--family", families);
  } else {
    info["families"] = fmt::format("{} in {} steps", families, options.steps);
    again += fmt::format(" --sweep {} --steps {}", families, options.steps);
  }
  note_option(info, "kinds", "--kind", names_of_kinds_asked(plan));
  if (const std::string separation = options.separation.of_families(); !separation.empty())
    note_option(info, "separation", "--separation", separation);
  if (options.search) {
    info["families"] += ", search";
    again += " --search";
  }
  if (!options.mesh.empty()) {
    info["scene"] = printable(fmt::format("{}", fmt::join(options.mesh, " ")));
    info["scene sha256"] = digest_of(options.mesh);
    again += " --mesh";
    for (const std::string& each : options.mesh) again += " " + printable_argument(each);
  }
  if (!options.near.empty()) {
    info["near sha256"] = digest_of(options.near);
    for (const auto& path : options.near)
      info["near"] += (info["near"].empty() ? "" : " ") + printable(path.string());
    for (const auto& path : options.near) again += " --near " + printable_argument(path.string());
  }
  info["cases"] = std::string(until_the_time_is_over);
  if (plan.cases != 0) {
    note_option(info, "cases", "--cases", fmt::format("{}", plan.cases));
  } else if (plan.first != 0) {
    info["cases"] = fmt::format("the first {}", plan.first);
    again += fmt::format(" --first {}", plan.first);
  }
  return info;
}

}  // namespace

int record_campaign(const CampaignOptions& options) {
  const auto start = Stop::Clock::now();
  Stop stop(interrupted());
  TimeLimit time;
  if (!options.time.empty()) stop.limit(*(time = parse_duration(options.time, "--time")));
  const Subjects subjects = in_time(options, stop, "the CCDs take longer to load",
                                    [&] { return options.trial.make_subjects(stop); });
  CampaignPlan plan;
  plan.families = in_time(options, stop, "the pairs of meshes and simulations take longer to collect",
                          [&] { return chosen_families(options, subjects, stop); });
  plan.seed = options.seed;
  plan.cases = options.cases;
  plan.first = options.first;
  plan.comparison = options.trial.comparison;
  plan.jobs = options.trial.jobs;
  plan.shrink = !options.trial.no_shrink;
  std::tie(plan.shard, plan.shards) = parse_shard(options.shard);

  Record record(options.record, info_of(options, plan, subjects),
                {.index = plan.shard, .count = plan.shards, .environment = plugin_environment(subjects)});
  plan.before = record.statistics();
  plan.findings_before = record.findings();
  const bool only_time_ends_it = plan.cases == 0 && plan.first == 0;
  if (only_time_ends_it) *time -= std::chrono::duration<double>(record.shard().seconds);
  if (time) stop.limit(*time -= Stop::Clock::now() - start);
  CampaignProgress reached;
  {
    Progress progress(options.record.quiet);
    bool was_asking = true;
    reached = run_campaign(
        plan, subjects,
        [&](TrialResult&& result, const CampaignProgress& now) {
          record.add(std::move(result));
          if (was_asking && !now.is_asking) record.save_now();
          was_asking = now.is_asking;
          if (progress.due()) progress.show(show(now, time, record.statistics()), part_done(now, time));
          return true;
        },
        stop);
  }
  if (!stop.is_requested()) record.add_unasked(subjects);
  return record.finish(stop.is_requested(), reached.complete || (only_time_ends_it && !stop.is_requested()));
}

}  // namespace nearmiss::tools
