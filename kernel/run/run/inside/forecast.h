// Forecasts of the tetrahedra, memory, time and disk of a run, made from surfaces before anything is meshed.
#pragma once

#include <string>
#include <vector>

#include "run/report/report.h"
#include "run/request/run_choices.h"

namespace kerf {

/// The forecast for filling one body.
struct Forecast {
    double tets = 0;
    double seconds = 0;       ///< seconds of one worker, at the pace of a core of 2.5 GHz
    double memory_bytes = 0;  ///< most resident memory of its worker
};

/// The measures of a body from which filling it is forecast.
struct BodyToFill {
    double facets = 0;
    double tets_at_facets = 0;  ///< result of tets_at_facets() (fill/volume/tet_forecast.h)
    double volume = 0;          ///< the sized volume (surface/size/volume_samples.h), here and below
};

/// Computes the forecast from the numbers that are known of the mesher that the options name (MesherForecast). The
/// memory is that of a body with more tetrahedra for its facets than most.
Forecast forecast(const BodyToFill& body, const MesherOptions& mesher);

/// Returns the seconds that this machine, as busy as it is, takes for one second of the core that forecasts speak of.
/// It is told from the `seconds` that it took to read and check a surface of so many `facets`; mostly within a factor
/// of two of the pace that its workers then have.
double pace_of_reading(double seconds, double facets);

/// Chooses K, the number of parts, where the user gives none: four for each worker of all ranks, fewer if they would be
/// tiny, more where a worker would otherwise have too little memory for its part; never more than `most` >= 1. The
/// number of workers must be known. Throws Error(usage) if no number of parts would do.
std::int32_t choose_parts(const WorkerOptions& workers, const MesherOptions& mesher, double facets, double volume,
                          int ranks, std::int32_t most);

/// The facets of a body when sizes change: they stay, or follow the size of the tetrahedra that are wanted, as those of
/// a remeshed surface do.
enum class Facets { are_given, follow_size };

/// Refuses a run that cannot end well, before anything is cut. Throws Error(memory), with the number of tetrahedra and
/// the way out, if, with the most tetrahedra that the mesher is known to make, one of so many `parts` would hold more
/// than their numbers can count, or the files would not fit on the disk of RunRequest::output.
void check_budget(const RunChoices& choices, const MesherOptions& mesher, std::int32_t parts, double facets,
                  double volume, Facets of_surface = Facets::are_given);

/// Returns one line on parts, tetrahedra, memory and time with the `workers` of all ranks; with `every_part` a table
/// below it. Seconds are multiplied by `pace`.
std::string plan_text(const std::vector<PartReport>& parts, const MesherOptions& mesher, int workers, bool every_part,
                      double pace = 1);

/// Returns one line on the cost of reading and cutting the surface on the first rank: wall clock, and the most memory
/// that was resident at once. A run spends both before its parts are meshed.
std::string plan_text(double seconds, std::int64_t peak_rss_bytes);

/// Returns one line on the size that was found for a number of tetrahedra.
std::string plan_text(const FoundSize& found);

/// The forecast of a run while its parts end, one after the other: forecasts of single parts, corrected by how far
/// those of the parts that have ended were off.
class RunningForecast {
 public:
    /// Takes all parts of the run, and the workers of all ranks. Parts that an interrupted run has finished count as
    /// parts that have ended, but their seconds do not count.
    RunningForecast(const std::vector<PartReport>& parts, MesherOptions mesher, int workers);
    /// Counts a part that has ended, well or not; each is to be counted once, resumed ones too.
    void add(const PartReport& part);

    /// Returns the number of tetrahedra that is expected of the whole run.
    double tets() const;
    /// Returns the seconds until the last part ends, if the first began `elapsed` seconds ago; negative if no part has
    /// ended in this run yet.
    double seconds_left(double elapsed) const;

 private:
    MesherOptions mesher_;
    int workers_;
    double tets_ahead_ = 0, seconds_ahead_ = 0;        // forecast of parts that have not ended
    double tets_forecast_ = 0, tets_found_ = 0;        // forecast and result of parts that have ended well
    double seconds_forecast_ = 0, seconds_found_ = 0;  // forecast and result of parts that have ended in this run
};

}  // namespace kerf
