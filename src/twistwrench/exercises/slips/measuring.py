"""Slips of measuring time (sections 49.7 and 49.11)."""

from ..text import Text
from .slip import Slip

__all__ = ["MEASURING"]

MEASURING = {
    "ratio-inverted": Slip(
        Text("the ratio is upside down", "比值取了倒数"),
        Text("Asked is the time of the second over that of the first.", "要的是第二个的时间除以第一个的时间。"),
        "49.7",
    ),
    "single-call": Slip(
        Text("a single call is timed", "只计时了一次调用"),
        Text(
            "The first call is the odd one: caches are cold, libraries are still being loaded.",
            "第一次调用最不典型：缓存是冷的，库还在加载。",
        ),
        "49.7",
    ),
    "blocks-in-turn": Slip(
        Text("all calls of the one, then all of the other", "先测完一个，再测另一个"),
        Text(
            "A machine slows down as it gets hot or as others use it, and only the second suffers. Call them in turn.",
            "机器会因发热或其他任务而变慢，那样只有后测的变慢。应轮流调用两者。",
        ),
        "49.7",
    ),
    "mean-of-times": Slip(
        Text("the mean of the times, in place of the median or the shortest", "用了平均时间，而不是中位数或最短时间"),
        Text(
            "A single interruption can outweigh all the calls. Whatever else the machine does only adds time.",
            "一次中断就可能超过全部调用的总和。机器的其他活动只会使时间变长。",
        ),
        "49.7",
    ),
    "mean-of-blocks": Slip(
        Text("one block of calls for each, divided by their number", "各测一整块调用，再除以次数"),
        Text(
            "Whatever disturbs the machine meanwhile goes into one of the blocks. Time each call, in turn, and take "
            "the median or the shortest.",
            "期间的任何干扰都落入其中一块。应轮流逐次计时，取中位数或最短时间。",
        ),
        "49.7",
    ),
    "other-clock": Slip(
        Text("the clock that is handed in is not read", "没有读取传入的时钟"),
        Text(
            "Call `clock()` before and after. In earnest it is `time.perf_counter`; the check hands in one of its own.",
            "在前后各调用一次 `clock()`。实际测量时它是 `time.perf_counter`；检验时传入的是另一个时钟。",
        ),
        "49.7",
    ),
    "order-for-time": Slip(
        Text(
            "an order of growth is taken for a time: N = 18 for O(N²)/O(N)",
            "把复杂度的阶当成了时间：由 O(N²)/O(N) 得 N = 18",
        ),
        Text(
            "Orders say how times grow, not how long they are. Constants decide at N = 18: measure.",
            "阶只说明时间怎样增长，不说明有多长。N = 18 时由常数决定：要实际测量。",
        ),
        "49.7",
    ),
    "time-for-ratio": Slip(
        Text("a time in seconds in place of a ratio", "给出的是秒数，而不是比值"),
        Text(
            "Machines differ; the ratio of two times on one machine tells more.",
            "机器各不相同；同一台机器上两个时间之比更有意义。",
        ),
        "49.7",
    ),
}
