#pragma once
// A packed bed as files: bed.h5 keeps everything bit for bit, the CSV files are for people and other
// programs.
#include <optional>
#include <string>

#include "bed/packed_bed.hpp"
#include "bed/run_record.hpp"

namespace packbed {

/// Writes poses, shapes, container, densities, contacts, provenance and, when given, the record of the run as
/// one HDF5 file that ends with a line holding its length and the hash of its bytes. Throws SystemError.
void write_bed(const std::string& path, const PackedBed& bed, const RunRecord* record = nullptr);

/// Reads bed.h5, or the bed.h5 of a result folder, bit for bit what was written. A missing, cut, changed or
/// foreign file is an InputError (the hash is checked before HDF5 sees the file).
PackedBed read_bed(const std::string& path_or_folder);

/// The record that the bed was written with, if any; errors as read_bed.
std::optional<RunRecord> read_run_record(const std::string& path_or_folder);

/// id,shape,x_m,y_m,z_m,qw,qx,qy,qz,scale: index of the shape, centre of mass and rotation from the shape's
/// own frame; numbers with as many digits as give back the same double.
void write_poses_csv(const std::string& path, const PackedBed& bed);

/// a,b,x_m,y_m,z_m,fx_N,fy_N,fz_N,overlap_m: force on a; b is -1 for the container.
void write_contacts_csv(const std::string& path, const PackedBed& bed);

}  // namespace packbed
