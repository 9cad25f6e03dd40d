// Whether campaigns that are added up asked a subject the same random queries, or have the same step of a
// simulation, which would count twice.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "reports/campaign/campaign.hpp"

namespace nearmiss {

class AskedQueries {
 public:
  /// Adds a campaign, whose store has this name. Throws Error if a run of a campaign that was added before had
  /// the same seed and asked the same subject queries of the same family, or has the same step of a simulation.
  /// Shards of one run ask different queries.
  void add(const Campaign& campaign, const std::string& name);

 private:
  /// The queries that the runs of one task asked.
  struct Asked {
    RunInfo task;
    std::string files;  ///< those of the families "mesh" and "near", if they were asked
    std::string name;
    std::set<CountsKey> keys;
  };
  void add_simulations(const Campaign& campaign, const std::string& name);

  std::map<std::string, std::vector<Asked>> by_seed_;
  std::set<SimulatedStepKey> simulated_;
};

}  // namespace nearmiss
