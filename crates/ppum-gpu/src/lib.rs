//! Draws fields exactly at every pixel on graphics cards.
mod bins;
mod layout;
