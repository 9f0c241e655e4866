// SPDX-License-Identifier: Apache-2.0
#include "io/archive.h"

#include "base/error.h"
#include "io/run_directory.h"

#include <fmt/format.h>

namespace brisance {

ArchiveWriter::ArchiveWriter(std::filesystem::path path) : path_(std::move(path)), file_(hdf5::File::create(part_path(path_))) {}

ArchiveWriter::~ArchiveWriter() {
    std::error_code ignored;
    if (!closed_) std::filesystem::remove(part_path(path_), ignored);
}

void ArchiveWriter::note(const std::string& name, const std::string& text) { file_.set_attribute(name, text); }

void ArchiveWriter::close() {
    note("checksum", fmt::format("{:016x}", hash_.value()));
    file_.close();
    publish(path_);
    closed_ = true;
}

void ArchiveReader::finish() const {
    const std::string found = fmt::format("{:016x}", hash_.value()), wanted = note("checksum");
    if (found != wanted) fail(fmt::format("{}: its checksum is {}, the one written into it is {}: the file is damaged", file_.where(), found, wanted));
}

void ArchiveReader::fail(const std::string& what) { throw ResourceError(what); }

}  // namespace brisance
