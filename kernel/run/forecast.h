// What a run will need, told from surfaces before anything is meshed.
#pragma once

#include <string>
#include <vector>

#include "run/report.h"

namespace kerf {

/// What filling one body will take.
struct Forecast {
    double tets = 0;
    double seconds = 0;       ///< of one worker, at the pace of a core of 2.5 GHz
    double memory_bytes = 0;  ///< resident, of its worker
};

/// By what is known of the mesher that the options name (MesherForecast). V is the sized volume
/// (size/volume_samples.h), here and below, and a the reference volume of the field.
Forecast forecast(double facets, double volume, const MesherOptions& mesher);

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

/// One line on parts, tetrahedra, memory and time; with `every_part` a table below it.
std::string plan_text(const std::vector<PartReport>& parts, const RunOptions& options, int ranks, bool every_part);

}  // namespace kerf
