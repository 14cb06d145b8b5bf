// What a run will need, told from surfaces before anything is meshed.
#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace kerf {

/// What filling one body will take.
struct Forecast {
    double tets = 0;
    double seconds = 0;       ///< of one worker, at the pace of a core of 2.5 GHz
    double memory_bytes = 0;  ///< resident, of its worker
};

/// What is known of a body before it is filled.
struct BodyToFill {
    double facets = 0;
    double tets_at_facets = 0;  ///< of tets_at_facets() (volume/tet_forecast.h)
    double volume = 0;          ///< the sized volume (size/volume_samples.h), here and below
};

/// Forecasts by what is known of the mesher that the options name (MesherForecast). The memory is that of a body with
/// more tetrahedra for its facets than most.
Forecast forecast(const BodyToFill& body, const MesherOptions& mesher);

/// The seconds of this machine, as busy as it is, for one of the core that forecasts speak of, by those that it took to
/// read and check a surface of so many facets. Within a factor of two of what its workers then do, mostly.
double pace_of_reading(double seconds, double facets);

/// K where the user gives none: four parts for each worker of all ranks, fewer if they would be tiny, more where
/// a worker with options.memory_mb would otherwise have too little for its part; never more than `most` >= 1. The
/// options must be resolved. Throws Error(usage) if no number of parts would do.
std::int32_t choose_parts(const RunOptions& options, double facets, double volume, int ranks, std::int32_t most);

/// Whether facets are what the surface has, or as small as the tetrahedra are wanted: those of a remeshed one.
enum class Facets { are_given, follow_size };

/// Refuses what cannot end well before anything is cut: Error(memory), with the number of tetrahedra and the way out,
/// if by forecast() one of options.decompose.parts parts would hold more tetrahedra than their numbers can count, or
/// the files would not fit on the disk of options.output.
void check_budget(const RunOptions& options, double facets, double volume, Facets of_surface = Facets::are_given);

/// One line on parts, tetrahedra, memory and time; with `every_part` a table below it. Seconds are multiplied by
/// `pace`.
std::string plan_text(const std::vector<PartReport>& parts, const RunOptions& options, int ranks, bool every_part,
                      double pace = 1);

/// One line on what the first rank has taken up to here to read the surface and to cut it: wall clock, and the most
/// memory that was resident at once. A run has both in front of what the parts take.
std::string plan_text(double seconds, std::int64_t peak_rss_bytes);

/// One line on the size that was found for a number of tetrahedra.
std::string plan_text(const FoundSize& found);

/// What is expected of a run while its parts end, one after the other: forecasts, corrected by how far those of the
/// parts that have ended were off.
class RunningForecast {
 public:
    /// Parts that an interrupted run has finished count as parts that have ended, but not their seconds.
    RunningForecast(const std::vector<PartReport>& parts, const RunOptions& options, int ranks);
    /// The part has ended, well or not; each once, resumed ones too.
    void add(const PartReport& part);

    /// The forecast of the whole run.
    double tets() const;
    /// Until the last part ends, if the first began so many seconds ago; negative if no part has told yet.
    double seconds_left(double elapsed) const;

 private:
    const RunOptions& options_;
    int workers_;
    double tets_ahead_ = 0, seconds_ahead_ = 0;        // forecast of parts that have not ended
    double tets_forecast_ = 0, tets_found_ = 0;        // of parts that have ended well
    double seconds_forecast_ = 0, seconds_found_ = 0;  // of parts that have ended in this run
};

}  // namespace kerf
