//! Reading of models, records and units, and writing of tables. One binary: a dozen and a half would take longer to link.

mod accounted;
mod assumptions;
mod capacity;
mod codes;
mod damage;
mod defaults;
mod faults;
mod fixture;
mod formats;
mod garbage;
mod grounds;
mod hinges;
mod layouts;
mod measured;
mod motions;
mod mutate;
mod plain_files;
mod plans;
mod records;
mod shear_failure;
mod shipped_files;
mod soil;
mod space_frames;
mod study_files;
mod tables;
mod usual_ranges;
