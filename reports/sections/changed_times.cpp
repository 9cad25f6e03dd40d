#include "reports/sections/baseline.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "corpus/query_text.hpp"
#include "reports/statistics/family.hpp"

namespace nearmiss {

namespace {

/// A subject's families are compared with each other if the subject has times for at least this many pairs of
/// a family and a kind.
constexpr std::size_t fewest_families = 8;
/// Standard deviations of log(time now / time before) if nothing has changed. Their squares are added to the
/// variance that follows from the spread among batches. For a family that is compared with the subject's
/// other families, the standard deviation is estimated from the spread among these families, but is at least
/// `spread_of_family`. For a subject that is compared with other subjects, it is assumed to be
/// `spread_of_subject`; for the only subject of a campaign, `spread_of_machine`.
constexpr double spread_of_family = 0.05;
constexpr double spread_of_subject = 0.08;
constexpr double spread_of_machine = 0.15;

CountsKey whole(const std::string& subject) { return {subject, {}, std::string(ChangedTime::all_families)}; }

bool is_whole(const CountsKey& key) { return key.family == ChangedTime::all_families; }

double square(double x) { return x * x; }

/// The median of the values. If the number of values is even, this is the one of the two middle values that
/// is nearer to 0.
double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const double low = values[(values.size() - 1) / 2];
  const double high = values[values.size() / 2];
  return std::abs(low) < std::abs(high) ? low : high;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// An estimate of the variance of the distribution from which the values are drawn; 0 for a single value.
double sample_variance(const std::vector<double>& values) {
  if (values.size() < 2) return 0;
  const double middle = mean(values);
  double squares = 0;
  for (const double each : values) squares += square(each - middle);
  return squares / static_cast<double>(values.size() - 1);
}

/// A robust estimate of the variance of values around 0: outliers hardly change it.
double usual_variance(std::vector<double> values) {
  for (double& each : values) each = std::abs(each);
  return square(1.4826 * median(std::move(values)));  // the estimate is exact for a normal distribution
}

struct Variance {
  double value = 0;
  double weight = 0;  ///< square(value) divided by the degrees of freedom of the estimate

  Variance() = default;
  Variance(double v, double degrees_of_freedom) : value(v), weight(square(v) / degrees_of_freedom) {}

  Variance& operator+=(const Variance& other) {
    value += other.value;
    weight += other.weight;
    return *this;
  }
  Variance operator*(double factor) const {
    Variance product;
    product.value = factor * value;
    product.weight = square(factor) * weight;
    return product;
  }
  /// The degrees of freedom of the variance; for a sum of variances, the approximation of Welch and
  /// Satterthwaite.
  [[nodiscard]] double degrees_of_freedom() const { return std::min(square(value) / weight, 1e6); }
};

/// The logarithm of a time per query in ns. It is the mean over all batches, weighted by their numbers of
/// queries.
struct LogTime {
  double mean = 0;
  /// The variance of `mean`. Assumes that a batch's variance is inversely proportional to its number of
  /// queries.
  Variance variance = {};
};

/// The mean log time over the batches in `times`. Returns nothing unless at least two batches have different
/// times.
std::optional<LogTime> log_time(const SubjectTimes& times) {
  constexpr double ps_per_ns = 1000;
  double queries = 0;
  double sum = 0;
  double squares = 0;
  std::size_t batches = 0;
  const auto each_bin = [&](const auto& use) {
    for (const auto& [key, of_family] : times.batches)
      for (const auto& [ps, count] : of_family.bins())
        use(std::log(static_cast<double>(ps) / ps_per_ns), static_cast<double>(count));
  };
  each_bin([&](double log, double count) {
    queries += count;
    sum += count * log;
    ++batches;
  });
  if (batches < 2) return std::nullopt;
  each_bin([&](double log, double count) { squares += count * square(log - sum / queries); });
  const auto free = static_cast<double>(batches - 1);
  return LogTime{sum / queries, Variance(squares / free / queries, free)};
}

using LogTimes = std::map<CountsKey, LogTime>;

LogTimes log_times(const Statistics& statistics) {
  LogTimes times;
  for (const auto& [key, counts] : statistics.counts)
    if (const auto time = log_time(counts.times); time && is_random(key.family)) times[key] = *time;
  return times;
}

/// The logarithm of time now / time before, for each earlier campaign. Each logarithm is the sum of two
/// parts, an entry of `common` and an entry of `own`.
struct Ratios {
  /// the part that is shared with the ratios of other times, for example because the machine is busy
  std::vector<double> common = {};
  std::vector<double> own = {};  ///< the part that is not shared with the ratios of other times
  Variance sampling = {};        ///< sum of the variances of the earlier times

  [[nodiscard]] double change() const { return mean(own); }
  [[nodiscard]] double campaigns() const { return static_cast<double>(own.size()); }
  /// The variance of the difference between the log time now and the mean of the earlier log times, divided
  /// by the variance of a single log time.
  [[nodiscard]] double of_difference() const { return 1 + 1 / campaigns(); }
};

/// The times of a campaign, and their ratios to the times of earlier campaigns.
class Times {
 public:
  explicit Times(const Statistics& now) : now_(log_times(now)) {
    for (const auto& [key, time] : now_) {
      ++families_[key.subject];
      kinds_[key.subject] |= bit_of(key.kind);
      whole_[key.subject] += time.mean;
    }
    for (auto& [subject, sum] : whole_) sum /= static_cast<double>(families_[subject]);
  }

  void compare_with(const Statistics& earlier) {
    const LogTimes before = log_times(earlier);
    std::map<std::string, std::vector<double>> by_subject;
    for (const auto& [key, time] : now_)
      if (const auto same = before.find(key); same != before.end())
        by_subject[key.subject].push_back(time.mean - same->second.mean);
    std::map<std::string, double> of_subject;
    std::vector<double> of_all{0};
    for (const auto& [subject, ratios] : by_subject) of_all.push_back(of_subject[subject] = median(ratios));
    const double of_machine = median(of_all);
    for (const auto& [subject, ratio] : of_subject) note(whole(subject), ratio, of_machine, {});
    for (const auto& [key, time] : now_)
      if (const auto same = before.find(key); same != before.end())
        note(key, time.mean - same->second.mean,
             has_spread(key.subject) ? of_subject.at(key.subject) : of_machine, same->second.variance);
  }

  [[nodiscard]] std::vector<ChangedTime> tested() const {
    std::map<std::string, Variance> spreads;
    for (const auto& [subject, families] : families_) spreads[subject] = spread_of_families(subject);
    std::vector<ChangedTime> tested;
    for (const auto& [key, ratios] : ratios_) {
      const double now = is_whole(key) ? whole_.at(key.subject) : now_.at(key).mean;
      const double expected = now - ratios.change();
      Variance variance = sampling(key);
      variance +=
          is_whole(key) || !has_spread(key.subject) ? assumed_spread(ratios) : spreads.at(key.subject);
      const double deviation =
          std::sqrt(std::max(variance.value, sample_variance(ratios.own) * ratios.of_difference()));
      const boost::math::students_t student(variance.degrees_of_freedom());
      const int of = is_whole(key) ? kinds_.at(key.subject) : bit_of(key.kind);
      tested.push_back({key.subject, names_of_kinds(of, ", "), key.family,
                        std::exp(expected - mean(ratios.common)), std::exp(expected), std::exp(now),
                        2 * cdf(complement(student, std::abs(ratios.change()) / deviation))});
    }
    return tested;
  }

 private:
  [[nodiscard]] bool has_spread(const std::string& subject) const {
    return families_.at(subject) >= fewest_families;
  }

  void note(const CountsKey& key, double ratio, double common, const Variance& variance) {
    Ratios& place = ratios_[key];
    place.common.push_back(common);
    place.own.push_back(ratio - common);
    place.sampling += variance;
  }

  /// The part of the variance of a change that comes from the spread among batches.
  [[nodiscard]] Variance sampling(const CountsKey& key) const {
    Variance sum;
    if (is_whole(key)) {
      for (const auto& [other, ratios] : ratios_)
        if (other.subject == key.subject && !is_whole(other)) sum += sampling(other);
      return sum * (1 / square(static_cast<double>(families_.at(key.subject))));
    }
    const Ratios& ratios = ratios_.at(key);
    sum = now_.at(key).variance;
    sum += ratios.sampling * (1 / square(ratios.campaigns()));
    return sum;
  }

  /// The other part of the variance, for the change of a subject's time as a whole. If a subject has too few
  /// families for spread_of_families(), this value is also used for the change of each family's time.
  [[nodiscard]] Variance assumed_spread(const Ratios& ratios) const {
    const double spread = families_.size() > 1 ? spread_of_subject : spread_of_machine;
    return {square(spread) * ratios.of_difference() / 2, HUGE_VAL};
  }

  /// The other part of the variance, for the change of a single family's time. It is estimated from the
  /// spread among the changes of the subject's families.
  [[nodiscard]] Variance spread_of_families(const std::string& subject) const {
    std::vector<double> changes;
    std::vector<double> variances;
    double least = 0;
    for (const auto& [key, ratios] : ratios_) {
      if (key.subject != subject || is_whole(key)) continue;
      changes.push_back(ratios.change());
      variances.push_back(sampling(key).value);
      least = square(spread_of_family) * ratios.of_difference() / 2;
    }
    if (changes.size() < 2) return {least, 1};
    const auto free = static_cast<double>(changes.size() - 1);
    return {std::max(usual_variance(std::move(changes)) - median(std::move(variances)), least), free};
  }

  LogTimes now_;
  // for each subject, the number of its pairs of family and kind
  std::map<std::string, std::size_t> families_;
  std::map<std::string, int> kinds_;     // for each subject, the bits of the kinds for which it has times
  std::map<std::string, double> whole_;  // for each subject, the mean log time of its families and kinds
  std::map<CountsKey, Ratios> ratios_;
};

std::set<std::string> processors(const Campaign& campaign) {
  std::set<std::string> models;
  for (const Run& run : campaign.runs)
    for (const Shard& shard : run.shards)
      if (const auto cpu = shard.environment.find("cpu"); cpu != shard.environment.end())
        models.insert(cpu->second);
  return models;
}

}  // namespace

ComparedTimes compare_times(const Campaign& now, std::span<const Campaign> baseline, double risk) {
  ComparedTimes result;
  Times times(now.statistics);
  for (const Campaign& each : baseline)
    if (processors(each) == processors(now)) {
      times.compare_with(each.statistics);
      ++result.campaigns;
    }
  result.changed = times.tested();
  result.compared = result.changed.size();
  const double level = level_of(risk, result.compared);
  std::erase_if(result.changed, [&](const ChangedTime& each) { return each.p >= level; });
  return result;
}

}  // namespace nearmiss
