//! Doors of jostle: model files, ground motions, result files.
