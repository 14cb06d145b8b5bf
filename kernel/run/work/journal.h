// The journal of finished parts, so that an interruption costs no more than the parts under way.
#pragma once

#include <optional>
#include <string>

#include "run/work/part_queue.h"

namespace kerf {

/// A finished part. It is valid for a run that wants the same job done and finds the part's file as it was.
struct JournalEntry {
    FileHash job_hash = {0, 0};  ///< hash of the job's bytes and the options that shape the mesh, see hash_of_job()
    double timeout_seconds = 0;  ///< if an attempt has exceeded it: with another limit the part might be another
    PartOutcome outcome;

    template <class Archive>
    void archive(Archive& a) {
        a(job_hash, timeout_seconds, outcome);
    }
};

/// Returns a hash of all that the file of a part depends on: the job, the mesher's options, how often it may be
/// retried, and the program that does it, by the hash of its file: another build of the same version may mesh
/// otherwise.
FileHash hash_of_job(const PartJob& job, const MesherOptions& mesher, std::int32_t attempts,
                     const std::string& worker_hash);

/// Writes an entry, which is durable when this returns. Throws Error(io).
void write_journal_entry(const std::string& path, const JournalEntry& entry);

/// Returns the entry, if the file exists and is whole. A damaged entry counts as missing: its part is then meshed
/// again.
std::optional<JournalEntry> read_journal_entry(const std::string& path);

/// Returns the outcome in the journal, if it is that of this job, no other limit of time has shaped it, and the part's
/// file is still the same.
std::optional<PartOutcome> find_finished_part(const std::string& journal_file, const std::string& part_file,
                                              const FileHash& job_hash, double timeout_seconds);

}  // namespace kerf
