//! Which columns and beams a plane frame has, and their sections.

use super::{Frame, Section};

/// Storey or floor, and column line or bay, all counted from 0.
pub type FramePlace = [usize; 2];

impl Frame {
    /// Height over width above which columns shorten unless a model file says otherwise \[–\].
    pub const SLENDER: f64 = 3.0;
    /// Storeys above which they do.
    pub const TALL: usize = 10;

    /// Height over [`Self::SLENDER`] times the width, or storeys over [`Self::TALL`], whichever is greater: above 1 rigid columns make
    /// the frame noticeably too stiff \[–\].
    #[must_use]
    pub fn tallness(&self) -> f64 {
        let (height, width): (f64, f64) =
            (self.storey_heights.iter().sum(), self.spans.iter().sum());
        let storeys = self.storey_heights.len() as f64 / Self::TALL as f64;
        storeys.max(height / (Self::SLENDER * width))
    }

    /// Number of column lines.
    #[must_use]
    pub fn lines(&self) -> usize {
        self.spans.len() + 1
    }

    /// Where the column lines stand, from the first one on \[m\].
    #[must_use]
    pub fn line_positions(&self) -> Vec<f64> {
        let mut lines = vec![0.0];
        for span in &self.spans {
            lines.push(lines[lines.len() - 1] + span);
        }
        lines
    }

    /// Section of the column in a storey at a line, both counted from 0; `None` where there is no column.
    ///
    /// ```
    /// use jostle::{Frame, Section};
    ///
    /// let section = |flexural_rigidity| Section {
    ///     flexural_rigidity,
    ///     axial_rigidity: None,
    ///     shear_rigidity: None,
    ///     line_mass: 0.0,
    /// };
    /// let mut frame = Frame {
    ///     storey_heights: vec![3.0; 2],
    ///     spans: vec![6.0; 2],
    ///     columns: vec![section(60e6); 2],
    ///     beams: vec![section(50e6); 2],
    ///     ..Frame::default()
    /// };
    /// frame.own_columns.insert([0, 1], Some(section(90e6))); // a stronger one in the middle
    /// frame.own_columns.insert([1, 2], None); // the last bay has one storey
    /// frame.own_beams.insert([1, 1], None);
    /// assert_eq!(frame.column(0, 1), Some(&section(90e6)));
    /// assert_eq!(frame.column(1, 2), None);
    /// assert_eq!(frame.beam(1, 0), Some(&section(50e6)));
    /// assert!(frame.has_joint(1, 2) && !frame.has_joint(2, 2));
    /// ```
    #[must_use]
    pub fn column(&self, storey: usize, line: usize) -> Option<&Section> {
        match self.own_columns.get(&[storey, line]) {
            Some(own_column) => own_column.as_ref(),
            None => self.columns.get(storey).filter(|_| line < self.lines()),
        }
    }

    /// Section of the beam at a floor in a bay, both counted from 0; `None` where there is no beam.
    #[must_use]
    pub fn beam(&self, floor: usize, bay: usize) -> Option<&Section> {
        match self.own_beams.get(&[floor, bay]) {
            Some(own_beam) => own_beam.as_ref(),
            None => self.beams.get(floor).filter(|_| bay < self.spans.len()),
        }
    }

    /// Depth along the frame of the column or wall in a storey at a line, both counted from 0; 0 where it is not known \[m\].
    #[must_use]
    pub fn depth_of_column(&self, place: FramePlace) -> f64 {
        let depth = self.column_depths.get(&place).copied();
        self.wall(place)
            .map_or(depth.unwrap_or(0.0), |wall| wall.length)
    }

    /// All columns, storey by storey from the ground up, from left to right.
    pub fn all_columns(&self) -> impl Iterator<Item = (FramePlace, &Section)> {
        let places = (0..self.columns.len()).flat_map(|i| (0..self.lines()).map(move |j| [i, j]));
        places.filter_map(|place| Some((place, self.column(place[0], place[1])?)))
    }

    /// All beams, floor by floor from the ground up, from left to right.
    pub fn all_beams(&self) -> impl Iterator<Item = (FramePlace, &Section)> {
        let bays = self.spans.len();
        let places = (0..self.beams.len()).flat_map(move |i| (0..bays).map(move |j| [i, j]));
        places.filter_map(|place| Some((place, self.beam(place[0], place[1])?)))
    }

    /// Sections of columns, to change them: those of the storeys, then those that differ.
    pub fn column_sections_mut(&mut self) -> impl Iterator<Item = &mut Section> {
        let own_columns = self.own_columns.values_mut().flatten();
        self.columns.iter_mut().chain(own_columns)
    }

    /// Whether a floor, counted from 1, has a joint at a column line, counted from 0: a column stands below it, or the beams of two bays
    /// meet there. For floor 0, whether a column stands there.
    #[must_use]
    pub fn has_joint(&self, floor: usize, line: usize) -> bool {
        self.column(floor.saturating_sub(1), line).is_some() || self.beams_cross(floor, line)
    }

    /// Whether a floor, counted from 1, has beams on both sides of a column line, counted from 0.
    #[must_use]
    pub fn beams_cross(&self, floor: usize, line: usize) -> bool {
        let (Some(floor), Some(before)) = (floor.checked_sub(1), line.checked_sub(1)) else {
            return false;
        };
        self.beam(floor, before).is_some() && self.beam(floor, line).is_some()
    }

    /// Whether a beam is continuous over a column line, counted from 0: at that floor, counted from 1, no column ends there.
    #[must_use]
    pub fn is_continuous(&self, floor: usize, line: usize) -> bool {
        let ends = |storey| self.column(storey, line).is_some();
        !ends(floor.saturating_sub(1)) && !ends(floor)
    }

    /// Number of columns of a storey, counted from 0.
    #[must_use]
    pub fn columns_in(&self, storey: usize) -> usize {
        let lines = 0..self.lines();
        lines
            .filter(|line| self.column(storey, *line).is_some())
            .count()
    }

    /// The first and the last column line with a joint at a floor, counted from 1; of the feet for floor 0.
    #[must_use]
    pub fn outer_lines(&self, floor: usize) -> Option<[usize; 2]> {
        let stands = |line: &usize| self.has_joint(floor, *line);
        let first = (0..self.lines()).find(stands)?;
        let last = (first..self.lines()).rfind(stands)?;
        Some([first, last])
    }

    /// How far the first and the last joint of a floor, counted from 1, stand inside the first and the last column line of the frame \[m\].
    #[must_use]
    pub fn set_back(&self, floor: usize) -> [f64; 2] {
        let Some([first, last]) = self.outer_lines(floor) else {
            return [0.0; 2];
        };
        let sum = |spans: &[f64]| spans.iter().sum();
        [sum(&self.spans[..first]), sum(&self.spans[last..])]
    }

    /// Storeys in which a column stands, counted from 1, by column line.
    #[must_use]
    pub fn storeys_of_lines(&self) -> Vec<Vec<usize>> {
        let storeys = 1..=self.columns.len();
        let of_line = |line| {
            let stands = |storey: &usize| self.column(storey - 1, line).is_some();
            storeys.clone().filter(stands).collect()
        };
        (0..self.lines()).map(of_line).collect()
    }

    /// Length of the beams of a floor, counted from 0 \[m\].
    #[must_use]
    pub fn beam_length(&self, floor: usize) -> f64 {
        let bays = self.spans.iter().enumerate();
        bays.filter(|(bay, _)| self.beam(floor, *bay).is_some())
            .map(|(_, span)| span)
            .sum()
    }

    /// Whether every storey has a column of one section at every line, and every floor a beam of one section in every bay.
    #[must_use]
    pub fn is_regular(&self) -> bool {
        self.own_columns.is_empty() && self.own_beams.is_empty()
    }
}
