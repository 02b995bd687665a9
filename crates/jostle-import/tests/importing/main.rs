//! Tables and text models written from buildings that are known, imported again.

mod book;
mod carried;
mod examples;
mod frames;
mod irregular;
mod refused;
mod tables;
mod walls;
mod workbooks;
