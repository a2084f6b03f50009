//! Isolated platforms and rows of panels against a tree of bodies by Newton and Euler, known answers, conservation.

mod contributions;
mod craft;
mod derivatives;
mod energies;
mod engine;
mod equations;
mod judge;
mod kind;
mod known;
mod linear;
mod panels;
mod runs;
mod suspension;
mod tree;
