#include "run/work/journal.h"

#include <filesystem>

#include "base/core/error.h"
#include "base/core/record.h"
#include "files/io/durable_file.h"
#include "files/io/file_bytes.h"
#include "files/io/run_manifest.h"

namespace kerf {

FileHash hash_of_job(const PartJob& job, const MesherOptions& mesher, std::int32_t attempts,
                     const std::string& worker_hash) {
    Hasher hasher;
    hasher.add(std::span<const char>(to_bytes(job)));
    hasher.add(std::span<const char>(to_bytes(mesher)));
    hasher.add(std::span<const std::int32_t>(&attempts, 1));
    hasher.add(std::span<const char>(worker_hash));
    return hasher.digest();
}

void write_journal_entry(const std::string& path, const JournalEntry& entry) {
    write_durable_file(path, to_record(entry));
}

std::optional<JournalEntry> read_journal_entry(const std::string& path) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) return {};
    try {
        return from_record<JournalEntry>(read_file(path));
    } catch (const Error&) {  // it cannot be read
        return {};
    }
}

std::optional<PartOutcome> find_finished_part(const std::string& journal_file, const std::string& part_file,
                                              const FileHash& job_hash, double timeout_seconds) {
    const std::optional<JournalEntry> entry = read_journal_entry(journal_file);
    if (!entry || entry->job_hash != job_hash) return {};
    if (entry->timeout_seconds > 0 && entry->timeout_seconds != timeout_seconds) return {};
    try {
        if (describe_file("", part_file).hash == hash_text(entry->outcome.result.file_hash)) return entry->outcome;
    } catch (const Error&) {  // missing or damaged
    }
    return {};
}

}  // namespace kerf
