"""Robots that tests share: each is read once, and a program that one test has asked for is there for the next."""

from functools import cache

import twistwrench as tw

__all__ = ["shared"]

shared = cache(tw.load)
