!=== bookerrno
! rule: arguments of BookErrNo
! source: [manual] 3HAC050917
MODULE Demo
    VAR errnum v_errnum;
    PROC main()
        BookErrNo v_errnum;
        BookErrNo;  ! -> RG311?
        BookErrNo v_errnum \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== errlog
! rule: arguments of ErrLog
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        ErrLog 1, "x", "x", "x", "x", "x";
        ErrLog 1 \W, "x", "x", "x", "x", "x";
        ErrLog 1 \I, "x", "x", "x", "x", "x";
        ErrLog 1, "x", "x", "x", "x";  ! -> RG311
        ErrLog 1, "x", "x", "x", "x", "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== errraise
! rule: arguments of ErrRaise
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        ErrRaise "x", 1, "x", "x", "x", "x", "x";
        ErrRaise "x", 1, "x", "x", "x", "x";  ! -> RG311
        ErrRaise "x", 1, "x", "x", "x", "x", "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== errwrite
! rule: arguments of ErrWrite
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        ErrWrite "x", "x";
        ErrWrite \W, "x", "x" \RL2:="x" \RL3:="x" \RL4:="x";
        ErrWrite \I, "x", "x" \RL2:="x" \RL3:="x" \RL4:="x";
        ErrWrite "x";  ! -> RG311
        ErrWrite "x", "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== skipwarn
! rule: arguments of SkipWarn
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        SkipWarn;
        SkipWarn 1;  ! -> RG311
        SkipWarn \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== tperase
! rule: arguments of TPErase
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        TPErase;
        TPErase 1;  ! -> RG311
        TPErase \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== tpreadfk
! rule: arguments of TPReadFK
! source: [manual] 3HAC050917
MODULE Demo
    PERS bool pb;
    VAR signaldi di;
    VAR signaldo dout;
    VAR errnum e;
    VAR num n;
    VAR btnres r;
    PROC main()
        TPReadFK n, "t", "1", "2", "3", "4", stEmpty;
        TPReadFK n, "t", "1", "2", "3", "4", "5" \MaxTime:=1 \DIBreak:=di \DIPassive \DOBreak:=dout \DOPassive \PersBoolBreak:=pb \PersBoolPassive \BreakFlag:=e \UIActiveSignal:=dout;
        TPReadFK n, "t", "1", "2", "3", "4";  ! -> RG311
    ENDPROC
ENDMODULE
!=== tpreadnum
! rule: arguments of TPReadNum
! source: [manual] 3HAC050917
MODULE Demo
    VAR num v_num;
    VAR signaldi v_signaldi;
    VAR signaldo v_signaldo;
    PERS bool p_bool;
    VAR errnum v_errnum;
    PROC main()
        TPReadNum v_num, "x";
        TPReadNum v_num, "x" \MaxTime:=1 \DIBreak:=v_signaldi \DIPassive \DOBreak:=v_signaldo \DOPassive \PersBoolBreak:=p_bool \PersBoolPassive \BreakFlag:=v_errnum \UIActiveSignal:=v_signaldo;
        TPReadNum v_num;  ! -> RG311
        TPReadNum v_num, "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== tpshow
! rule: arguments of TPShow
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        TPShow 1;
        TPShow;  ! -> RG311?
        TPShow 1 \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== tpwrite
! rule: arguments of TPWrite
! source: [manual] 3HAC050917
MODULE Demo
    PROC main()
        TPWrite "x";
        TPWrite "x" \Num:=1;
        TPWrite "x" \Bool:=TRUE;
        TPWrite "x" \Pos:=[1, 2, 3];
        TPWrite "x" \Orient:=[1, 0, 0, 0];
        TPWrite "x" \Dnum:=1;
        TPWrite;  ! -> RG311?
        TPWrite "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== uialphaentry
! rule: arguments of UIAlphaEntry
! source: [manual] 3HAC050917
MODULE Demo
    VAR string r_string;
    VAR signaldi v_signaldi;
    VAR signaldo v_signaldo;
    PERS bool p_bool;
    VAR errnum v_errnum;
    VAR string v_string_array{2};
    PROC main()
        r_string := UIAlphaEntry();
        r_string := UIAlphaEntry(\Header:="x" \Message:="x" \Wrap \Icon:=1 \InitString:="x" \MaxTime:=1 \DIBreak:=v_signaldi \DIPassive \DOBreak:=v_signaldo \DOPassive \PersBoolBreak:=p_bool \PersBoolPassive \BreakFlag:=v_errnum \UIActiveSignal:=v_signaldo);
        r_string := UIAlphaEntry(\Header:="x" \MsgArray:=v_string_array \Wrap \Icon:=1 \InitString:="x" \MaxTime:=1 \DIBreak:=v_signaldi \DIPassive \DOBreak:=v_signaldo \DOPassive \PersBoolBreak:=p_bool \PersBoolPassive \BreakFlag:=v_errnum \UIActiveSignal:=v_signaldo);
        r_string := UIAlphaEntry(1);  ! -> RG311
        r_string := UIAlphaEntry(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== uiclientexist
! rule: arguments of UIClientExist
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := UIClientExist();
        r_bool := UIClientExist(1);  ! -> RG311
        r_bool := UIClientExist(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== uilistview
! rule: arguments of UIListView
! source: [manual] 3HAC050917
MODULE Demo
    VAR listitem v_listitem_array{2};
    VAR num r_num;
    VAR btnres v_btnres;
    VAR signaldi v_signaldi;
    VAR signaldo v_signaldo;
    PERS bool p_bool;
    VAR errnum v_errnum;
    VAR string v_string_array{2};
    PROC main()
        r_num := UIListView(v_listitem_array);
        r_num := UIListView(\Result:=v_btnres \Header:="x", v_listitem_array \Buttons:=1 \Icon:=1 \DefaultIndex:=1 \MaxTime:=1 \DIBreak:=v_signaldi \DIPassive \DOBreak:=v_signaldo \DOPassive \PersBoolBreak:=p_bool \PersBoolPassive \BreakFlag:=v_errnum \UIActiveSignal:=v_signaldo);
        r_num := UIListView(\Result:=v_btnres \Header:="x", v_listitem_array \BtnArray:=v_string_array \Icon:=1 \DefaultIndex:=1 \MaxTime:=1 \DIBreak:=v_signaldi \DIPassive \DOBreak:=v_signaldo \DOPassive \PersBoolBreak:=p_bool \PersBoolPassive \BreakFlag:=v_errnum \UIActiveSignal:=v_signaldo);
        r_num := UIListView();  ! -> RG311
        r_num := UIListView(v_listitem_array \NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== uimessagebox
! rule: arguments of UIMessageBox
! source: [manual] 3HAC050917
MODULE Demo
    VAR btnres r_btnres;
    VAR signaldi v_signaldi;
    VAR signaldo v_signaldo;
    PERS bool p_bool;
    VAR errnum v_errnum;
    VAR string v_string_array{2};
    PROC main()
        r_btnres := UIMessageBox();
        r_btnres := UIMessageBox(\Header:="x" \Message:="x" \Wrap \Buttons:=1 \DefaultBtn:=1 \Icon:=1 \Image:="x" \MaxTime:=1 \DIBreak:=v_signaldi \DIPassive \DOBreak:=v_signaldo \DOPassive \PersBoolBreak:=p_bool \PersBoolPassive \BreakFlag:=v_errnum \UIActiveSignal:=v_signaldo);
        r_btnres := UIMessageBox(\Header:="x" \MsgArray:=v_string_array \Wrap \BtnArray:=v_string_array \DefaultBtn:=1 \Icon:=1 \Image:="x" \MaxTime:=1 \DIBreak:=v_signaldi \DIPassive \DOBreak:=v_signaldo \DOPassive \PersBoolBreak:=p_bool \PersBoolPassive \BreakFlag:=v_errnum \UIActiveSignal:=v_signaldo);
        r_btnres := UIMessageBox(1);  ! -> RG311
        r_btnres := UIMessageBox(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== uimsgbox
! rule: arguments of UIMsgBox
! source: [manual] 3HAC050917
MODULE Demo
    PERS bool pb;
    VAR signaldi di;
    VAR signaldo dout;
    VAR errnum e;
    VAR num n;
    VAR btnres r;
    PROC main()
        UIMsgBox "a";
        UIMsgBox \Header:="h", "a" \MsgLine2:="b" \MsgLine3:="c" \MsgLine4:="d" \MsgLine5:="e" \Wrap \Buttons:=btnOK \Icon:=iconInfo \Image:="i" \Result:=r \MaxTime:=1 \DIBreak:=di \DIPassive \DOBreak:=dout \DOPassive \PersBoolBreak:=pb \PersBoolPassive \BreakFlag:=e \UIActiveSignal:=dout;
        UIMsgBox;  ! -> RG311?
    ENDPROC
ENDMODULE
!=== uimsgwrite
! rule: arguments of UIMsgWrite
! source: [manual] 3HAC050917
MODULE Demo
    VAR signaldo dout;
    VAR string a{2};
    PROC main()
        UIMsgWrite "h", "m" \Wrap \Icon:=iconInfo \Image:="i" \UIActiveSignal:=dout;
        UIMsgWrite "h" \MsgArray:=a;
        UIMsgWrite "h", "m" \MsgArray:=a;  ! -> RG313
        UIMsgWrite "h";  ! -> RG311
        UIMsgWrite "h", "m" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
!=== uinumentry
! rule: arguments of UINumEntry
! source: [manual] 3HAC050917
MODULE Demo
    VAR num r_num;
    VAR signaldi v_signaldi;
    VAR signaldo v_signaldo;
    PERS bool p_bool;
    VAR errnum v_errnum;
    VAR string v_string_array{2};
    PROC main()
        r_num := UINumEntry();
        r_num := UINumEntry(\Header:="x" \Message:="x" \Wrap \Icon:=1 \InitValue:=1 \MinValue:=1 \MaxValue:=1 \AsInteger \MaxTime:=1 \DIBreak:=v_signaldi \DIPassive \DOBreak:=v_signaldo \DOPassive \PersBoolBreak:=p_bool \PersBoolPassive \BreakFlag:=v_errnum \UIActiveSignal:=v_signaldo);
        r_num := UINumEntry(\Header:="x" \MsgArray:=v_string_array \Wrap \Icon:=1 \InitValue:=1 \MinValue:=1 \MaxValue:=1 \AsInteger \MaxTime:=1 \DIBreak:=v_signaldi \DIPassive \DOBreak:=v_signaldo \DOPassive \PersBoolBreak:=p_bool \PersBoolPassive \BreakFlag:=v_errnum \UIActiveSignal:=v_signaldo);
        r_num := UINumEntry(1);  ! -> RG311
        r_num := UINumEntry(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
!=== uishow
! rule: arguments of UIShow
! source: [manual] 3HAC050917
MODULE Demo
    PERS uishownum p_uishownum;
    VAR num v_num;
    PROC main()
        UIShow "x", "x";
        UIShow "x", "x" \InitCmd:="x" \InstanceId:=p_uishownum \Status:=v_num \NoCloseBtn;
        UIShow "x";  ! -> RG311
        UIShow "x", "x" \NoSuchArgument;  ! -> RG312
    ENDPROC
ENDMODULE
